// The adapter behind a bus, as sysfs describes it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::drive {

struct Options;

struct Adapter {
  std::string bus;        ///< "can0", "local:x"
  std::string kind;       ///< "usb", "pci", "spi", "platform" (in the SoC), "virtual", "unknown"
  std::string driver{};   ///< "gs_usb", "vcan"; for a bus without an interface, a description
  std::string address{};  ///< where the adapter is connected: "1-4:1.0", "0000:03:00.0"
  std::string vendor_id{}, product_id{};  ///< hexadecimal digits; USB and PCI only
  std::string product{};                  ///< product name that the device reports; USB only
  std::string serial{};                   ///< USB only; empty: no serial number
  double usb_mbitps = 0;                  ///< 12: full speed; 0: not USB
};

/// The adapter of a kernel interface; a bus without an interface is "virtual". `sys`: where sysfs is mounted.
Adapter adapter_of(const std::string& bus, const std::filesystem::path& sys = "/sys");

/// The bus of a name on the command line: of "serial:NUMBER", the interface of the USB adapter with this
/// serial number; every other name is one. Error, one line: there is no such adapter, or it has several
/// interfaces.
Result<std::string> bus_of_adapter(const std::string& name, const std::filesystem::path& sys = "/sys");

/// One line, for example "can0: usb, gs_usb at 1-4:1.0, 1d50:606f 'candleLight', serial 0042".
std::string to_text(const Adapter& adapter);

/// The adapters of the buses of a run, without duplicates.
std::vector<Adapter> adapters_of(const Options& options);

}  // namespace canhil::drive
