// Tests how the adapter of an interface is identified in an artificial sysfs tree, and the hash of a file.
#include "bench/drive/adapter.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "bench/drive/file_identity.hpp"
#include "tests/own_folder.hpp"

namespace canhil::drive {
namespace {

namespace fs = std::filesystem;

class Adapters : public testing::Test {
 protected:
  void write(const fs::path& name, const std::string& text) const {
    fs::create_directories((sys_ / name).parent_path());
    std::ofstream(sys_ / name) << text << '\n';
  }
  void link(const fs::path& name, const fs::path& to) const {
    fs::create_directories((sys_ / name).parent_path());
    fs::create_directories(sys_ / to);
    fs::create_directory_symlink(sys_ / to, sys_ / name);
  }
  // Adds to the tree the interface `name` of a device with this subsystem and driver.
  void plug_in(const std::string& name, const fs::path& device, const std::string& bus,
               const std::string& driver) const {
    link("class/net/" + name, device / "net" / name);
    link(device / "net" / name / "device", device);
    link(device / "subsystem", "bus/" + bus);
    link(device / "driver", fs::path("bus") / bus / "drivers" / driver);
  }
  const test::OwnFolder own_;
  const fs::path sys_ = own_.path / "sys";
};

TEST_F(Adapters, OnUsb) {
  const fs::path device = "devices/pci0000:00/0000:00:14.0/usb1/1-4";
  plug_in("can0", device / "1-4:1.0", "usb", "gs_usb");
  write("devices/pci0000:00/0000:00:14.0/usb1/idVendor", "1d6b");  // the USB hub
  write(device / "idVendor", "1d50");
  write(device / "idProduct", "606f");
  write(device / "product", "candleLight USB to CAN adapter");
  write(device / "serial", "004200");
  write(device / "speed", "12");
  const Adapter found = adapter_of("can0", sys_);
  EXPECT_EQ(to_text(found),
            "can0: usb, gs_usb at 1-4:1.0, 1d50:606f 'candleLight USB to CAN adapter', serial 004200");
  EXPECT_EQ(found.usb_mbitps, 12);
}

TEST_F(Adapters, OnPciAndInTheSoc) {
  plug_in("can0", "devices/pci0000:00/0000:03:00.0", "pci", "peak_pciefd");
  write("devices/pci0000:00/0000:03:00.0/vendor", "0x001c");
  write("devices/pci0000:00/0000:03:00.0/device", "0x0013");
  EXPECT_EQ(to_text(adapter_of("can0", sys_)), "can0: pci, peak_pciefd at 0000:03:00.0, 001c:0013");
  plug_in("can1", "devices/platform/soc/40006400.can", "platform", "m_can_platform");
  EXPECT_EQ(to_text(adapter_of("can1", sys_)), "can1: platform, m_can_platform at 40006400.can");
  EXPECT_EQ(adapter_of("can1", sys_).usb_mbitps, 0);
}

TEST_F(Adapters, ThatAreNone) {
  link("class/net/vcan0", "devices/virtual/net/vcan0");
  EXPECT_EQ(to_text(adapter_of("vcan0", sys_)), "vcan0: virtual, virtual interface of the kernel");
  EXPECT_EQ(to_text(adapter_of("local:x?bitrate=500000", sys_)),
            "local:x?bitrate=500000: virtual, embedded bus");
  EXPECT_EQ(adapter_of("in-process", sys_).kind, "virtual");
  EXPECT_EQ(to_text(adapter_of("nocan7", sys_)), "nocan7: unknown");
}

TEST_F(Adapters, AreFoundByTheirSerialNumber) {
  const fs::path first = "devices/usb1/1-4", second = "devices/usb1/1-5";
  plug_in("can1", first / "1-4:1.0", "usb", "gs_usb");
  plug_in("can0", second / "1-5:1.0", "usb", "peak_usb");
  plug_in("can2", second / "1-5:1.1", "usb", "peak_usb");
  write(first / "idVendor", "1d50");
  write(first / "serial", "004200");
  write(second / "idVendor", "0c72");
  write(second / "serial", "77");
  EXPECT_EQ(bus_of_adapter("serial:004200", sys_), "can1");
  EXPECT_EQ(bus_of_adapter("can0", sys_), "can0") << "no serial number";
  EXPECT_EQ(bus_of_adapter("serial:77", sys_).error().message,
            "--bus 'serial:77': the adapter has several interfaces, expected one of can0, can2");
  EXPECT_EQ(bus_of_adapter("serial:1", sys_).error().message,
            "--bus 'serial:1': no adapter has this serial number, expected 004200, 77, 77");
}

TEST(FileIdentity, IsWhatSha256sumPrints) {
  const test::OwnFolder own;
  const std::string path = (own.path / "abc").string();
  std::ofstream(path) << "abc";
  const auto identity = identify_file(path);
  ASSERT_TRUE(identity);
  // FIPS 180-4, the example with one block.
  EXPECT_EQ(identity->sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(identity->bytes, 3U);
  EXPECT_FALSE(identify_file(own.path.string()));
  EXPECT_FALSE(identify_file((own.path / "none").string()));
}

}  // namespace
}  // namespace canhil::drive
