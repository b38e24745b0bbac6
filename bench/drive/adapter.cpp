#include "bench/drive/adapter.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

#include "bench/drive/buses.hpp"
#include "bench/drive/session.hpp"
#include "dbc/ports/local_bus.hpp"

namespace canhil::drive {
namespace {

namespace fs = std::filesystem;

// The first line of a sysfs attribute; empty: the attribute does not exist.
std::string attribute(const fs::path& folder, const char* name) {
  std::ifstream file(folder / name);
  std::string line;
  std::getline(file, line);
  return line;
}

std::string name_behind(const fs::path& link) {
  std::error_code unknown;
  return fs::read_symlink(link, unknown).filename().string();
}

// PCI ids have the prefix 0x (0x0c72), USB ids have none (0c72).
std::string without_prefix(const std::string& id) { return id.starts_with("0x") ? id.substr(2) : id; }

// Looks for the device in the folders above the interface: a device's folder contains its interfaces'
// folders.
void add_usb(Adapter& adapter, const fs::path& of_interface) {
  for (fs::path folder = of_interface; folder.has_relative_path(); folder = folder.parent_path()) {
    adapter.vendor_id = attribute(folder, "idVendor");
    if (adapter.vendor_id.empty()) continue;
    adapter.product_id = attribute(folder, "idProduct");
    adapter.product = attribute(folder, "product");
    adapter.serial = attribute(folder, "serial");
    const std::string speed = attribute(folder, "speed");
    adapter.usb_mbitps = speed.empty() ? 0 : std::strtod(speed.c_str(), nullptr);
    return;
  }
}

}  // namespace

Adapter adapter_of(const std::string& bus, const fs::path& sys) {
  if (BusName(bus).in_process)
    return {.bus = bus, .kind = "virtual", .driver = "no bus: the device is in hil-bench"};
  if (is_local(bus)) return {.bus = bus, .kind = "virtual", .driver = "embedded bus"};
  Adapter adapter{.bus = bus, .kind = "unknown"};
  std::error_code unknown;
  const fs::path interface = fs::canonical(sys / "class/net" / bus, unknown);
  if (unknown) return adapter;
  if (interface.string().find("/devices/virtual/") != std::string::npos) {
    adapter.kind = "virtual";
    adapter.driver = "virtual interface of the kernel";
    return adapter;
  }
  const fs::path device = fs::canonical(interface / "device", unknown);
  if (unknown) return adapter;
  adapter.address = device.filename().string();
  adapter.driver = name_behind(device / "driver");
  if (const std::string kind = name_behind(device / "subsystem"); !kind.empty()) adapter.kind = kind;
  if (adapter.kind == "usb") add_usb(adapter, device);
  if (adapter.kind == "pci") {
    adapter.vendor_id = without_prefix(attribute(device, "vendor"));
    adapter.product_id = without_prefix(attribute(device, "device"));
  }
  return adapter;
}

Result<std::string> bus_of_adapter(const std::string& name, const fs::path& sys) {
  constexpr std::string_view prefix = "serial:";
  if (!name.starts_with(prefix)) return name;
  const std::string serial = name.substr(prefix.size());
  std::vector<std::string> found, others;
  std::error_code unknown;
  for (const fs::directory_entry& one : fs::directory_iterator(sys / "class/net", unknown)) {
    const Adapter adapter = adapter_of(one.path().filename().string(), sys);
    if (adapter.serial.empty()) continue;
    (adapter.serial == serial ? found : others)
        .push_back(adapter.serial == serial ? adapter.bus : adapter.serial);
  }
  if (found.size() == 1) return found.front();
  std::ranges::sort(found);
  std::ranges::sort(others);
  return failure(found.empty()
                     ? fmt::format("--bus '{}': no adapter has this serial number, expected {}", name,
                                   others.empty() ? "one that is plugged in"
                                                  : fmt::format("{}", fmt::join(others, ", ")))
                     : fmt::format("--bus '{}': the adapter has several interfaces, expected one of {}", name,
                                   fmt::join(found, ", ")));
}

std::string to_text(const Adapter& adapter) {
  std::string text = fmt::format("{}: {}", adapter.bus, adapter.kind);
  if (!adapter.driver.empty()) text += ", " + adapter.driver;
  if (!adapter.address.empty()) text += " at " + adapter.address;
  if (!adapter.vendor_id.empty()) text += fmt::format(", {}:{}", adapter.vendor_id, adapter.product_id);
  if (!adapter.product.empty()) text += fmt::format(" '{}'", adapter.product);
  if (!adapter.serial.empty()) text += ", serial " + adapter.serial;
  return text;
}

std::vector<Adapter> adapters_of(const Options& options) {
  std::vector<Adapter> adapters{adapter_of(options.bus.text)};
  for (const auto& [node, bus] : options.bus_of) {
    if (std::ranges::find(adapters, bus, &Adapter::bus) == adapters.end())
      adapters.push_back(adapter_of(bus));
  }
  return adapters;
}

}  // namespace canhil::drive
