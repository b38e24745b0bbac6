#include "dbc/logs/foreign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace canhil::logs {
namespace {

using namespace std::string_view_literals;

struct Foreign {
  std::string_view beginning;
  std::string_view what;  // the name of the format
  std::string_view way;   // the command that converts the file {0}, or what to do
};

constexpr std::string_view by_python_can =
    "convert it with: python3 -m can.logconvert '{0}' '{0}.log' (Debian package python3-can)";
constexpr std::string_view by_asammdf =
    "convert it with: python3 -c 'import asammdf, sys; asammdf.MDF(sys.argv[1]).export(\"asc\", "
    "sys.argv[1])' '{0}' (pip install asammdf)";
constexpr std::string_view decompress_bzip2 = "decompress it with: bzip2 -dk '{0}'";
constexpr std::string_view decompress_xz = "decompress it with: xz -dk '{0}'";
constexpr std::string_view decompress_zstd = "decompress it with: zstd -d '{0}'";
constexpr std::string_view unpack = "unpack it with: unzip '{0}'";

constexpr std::array foreign{
    Foreign{"MDF     "sv, "an ASAM MF4 (MDF) measurement file", by_asammdf},
    Foreign{"UnFinMF "sv, "an ASAM MF4 (MDF) measurement file that was not closed", by_asammdf},
    Foreign{"SQLite format 3\0"sv, "an SQLite database", by_python_can},
    Foreign{"timestamp,arbitration_id"sv, "a CSV log of python-can", by_python_can},
    Foreign{"BZh"sv, "compressed with bzip2", decompress_bzip2},
    Foreign{"\xFD\x37zXZ\0"sv, "compressed with xz", decompress_xz},
    Foreign{"\x28\xB5\x2F\xFD"sv, "compressed with zstd", decompress_zstd},
    Foreign{"PK\x03\x04"sv, "a ZIP archive", unpack},
    Foreign{"\x89HDF\r\n"sv, "an HDF5 file", "export it as ASC or BLF"},
    Foreign{"MATLAB 5.0"sv, "a MATLAB file", "export it as ASC or BLF"},
    Foreign{"***BUSMASTER"sv, "a log of BUSMASTER",
            "convert it with BUSMASTER's format converter (Log to ASC)"},
};

struct Ending {
  std::string_view ending;
  std::string_view way;
};
constexpr std::string_view written_by_python_can =
    "; write a .log, and convert it with: python3 -m can.logconvert FILE.log FILE{0}";
constexpr std::array endings{
    Ending{".trc", written_by_python_can}, Ending{".csv", written_by_python_can},
    Ending{".db", written_by_python_can},
    Ending{".pcapng", "; write a .pcap, and convert it with: editcap -F pcapng FILE.pcap FILE{0}"},
    Ending{".gz", "; write a .log, and compress it with: gzip FILE.log"}};

}  // namespace

std::optional<std::string> foreign_format(std::string_view beginning, const std::string& name) {
  const auto found =
      std::ranges::find_if(foreign, [&](const Foreign& one) { return beginning.starts_with(one.beginning); });
  if (found == foreign.end()) return std::nullopt;
  return fmt::format("cannot read log '{}': it is {}; {}", name, found->what,
                     fmt::format(fmt::runtime(found->way), name));
}

std::string how_to_write(std::string_view ending) {
  const auto found = std::ranges::find(endings, ending, &Ending::ending);
  return found == endings.end() ? "" : fmt::format(fmt::runtime(found->way), ending);
}

}  // namespace canhil::logs
