// FMUs made for tests: a zip archive of the models in models/ and a modelDescription.xml.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <zip.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "bench/plant/registry.hpp"
#include "bench/scenario/section.hpp"
#include "tests/own_folder.hpp"

namespace canhil::test {

inline std::string content_of(const std::string& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return std::move(content).str();
}

inline std::string platform(int version) {
#if defined(__x86_64__)
  return version == 2 ? "linux64" : "x86_64-linux";
#else
  return "aarch64-linux";
#endif
}

struct Packed {
  std::string name, content{};
  unsigned mode = 0100644;
};

/// Writes a zip archive into the folder of this process.
inline void write_zip(const std::string& file, const std::vector<Packed>& all) {
  const std::string path = own_folder() + "/" + file;
  std::filesystem::remove(path);
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE, nullptr);
  ASSERT_NE(archive, nullptr);
  for (const Packed& one : all) {
    if (one.name.ends_with('/')) {
      ASSERT_GE(zip_dir_add(archive, one.name.c_str(), 0), 0);
      continue;
    }
    zip_source_t* source = zip_source_buffer(archive, one.content.data(), one.content.size(), 0);
    const zip_int64_t index = zip_file_add(archive, one.name.c_str(), source, 0);
    ASSERT_GE(index, 0) << one.name;
    zip_file_set_external_attributes(archive, static_cast<zip_uint64_t>(index), 0, ZIP_OPSYS_UNIX,
                                     one.mode << 16U);
  }
  ASSERT_EQ(zip_close(archive), 0);
}

/// A variable: its type by FMI 3.0; `more` are attributes of the type, `about` those of the variable.
struct Described {
  std::string name;
  int reference = 0;
  std::string type, causality, more{}, about{}, inner{};
};

inline std::string xml_of(int version, const Described& one) {
  const std::string head = fmt::format("name='{}' valueReference='{}' causality='{}' {}", one.name,
                                       one.reference, one.causality, one.about);
  if (version == 3) return fmt::format("<{0} {1} {2}>{3}</{0}>\n", one.type, head, one.more, one.inner);
  const std::string type = one.type == "Float64" ? "Real" : one.type == "Int32" ? "Integer" : one.type;
  return fmt::format("<ScalarVariable {}><{} {}/></ScalarVariable>\n", head, type, one.more);
}

/// A modelDescription.xml; `definitions` are the elements before the variables.
inline std::string description_of(
    int version, const std::string& model, const std::vector<Described>& all,
    const std::string& definitions = "",
    const std::string& capabilities = "canHandleVariableCommunicationStepSize='true'") {
  std::string variables;
  for (const Described& one : all) variables += xml_of(version, one);
  std::string token = model.substr(0, model.size() - 1);
  if (token == "stepless") token = "passing";
  if (token == "early") token = "heading";
  return fmt::format(
      "<?xml version='1.0' encoding='UTF-8'?>\n"
      "<fmiModelDescription fmiVersion='{}.0' modelName='m' {}='{{{}}}'>\n"
      "<CoSimulation modelIdentifier='{}' {}/>\n{}\n<ModelVariables>\n"
      "<{} name='time' valueReference='99' causality='independent' variability='continuous'{}"
      "{}</ModelVariables>\n<ModelStructure/></fmiModelDescription>\n",
      version, version == 2 ? "guid" : "instantiationToken", token, model, capabilities, definitions,
      version == 2 ? "ScalarVariable" : "Float64", version == 2 ? "><Real/></ScalarVariable>\n" : "/>\n",
      variables);
}

inline Packed binary_of(int version, const std::string& model) {
  return {.name = fmt::format("binaries/{}/{}.so", platform(version), model),
          .content = content_of(std::string(MODELS) + "/" + model + ".so"),
          .mode = 0100755};
}

/// Writes model.fmu.
inline void write_fmu(int version, const std::string& model, const std::string& description,
                      const std::vector<Packed>& more = {}) {
  std::vector<Packed> all{{.name = "modelDescription.xml", .content = description},
                          binary_of(version, model)};
  all.insert(all.end(), more.begin(), more.end());
  write_zip("model.fmu", all);
}

inline const plant::Kind& kind_of(std::string_view key) {
  return **std::ranges::find(plant::kinds(), key, [](const plant::Kind* one) { return one->key; });
}

struct ReadPlant {
  std::unique_ptr<plant::Plan> plan;
  std::string error;  ///< without the path of the scenario; empty: none
};

/// Reads a table [plant] with these keys.
inline ReadPlant read_plant(const std::string& keys, std::string_view kind = "fmu",
                            const std::vector<scenario::Setting>& settings = {}) {
  auto root = scenario::Section::parse("[plant]\n" + keys, own_folder() + "/test.toml", settings);
  scenario::Section section = root.table("plant");
  ReadPlant read{.plan = kind_of(kind).read(section), .error = {}};
  section.finish();
  const auto error = root.error();
  if (!error) return read;
  read.error = error->message;
  const std::string folder = own_folder() + "/";
  for (auto at = read.error.find(folder); at != std::string::npos; at = read.error.find(folder))
    read.error.erase(at, folder.size());
  return read;
}

/// The plan of model.fmu with further keys; a test fails if it has an error.
inline std::unique_ptr<plant::Plan> plan_of(const std::string& keys = "", bool in_process = false) {
  ReadPlant read =
      read_plant(fmt::format("file = 'model.fmu'\n{}{}", in_process ? "in_process = true\n" : "", keys));
  EXPECT_EQ(read.error, "");
  return std::move(read.plan);
}

/// While it exists, temporary folders are made in a folder of their own, and at its end, that folder is empty
/// and this process has no child.
class NothingLeft {
 public:
  NothingLeft() {
    std::filesystem::create_directories(folder_);
    setenv("TMPDIR", folder_.c_str(), 1);
  }
  NothingLeft(const NothingLeft&) = delete;
  NothingLeft& operator=(const NothingLeft&) = delete;
  ~NothingLeft() {
    unsetenv("TMPDIR");
    EXPECT_TRUE(std::filesystem::is_empty(folder_)) << folder_;
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
  }
  [[nodiscard]] bool empty() const { return std::filesystem::is_empty(folder_); }

 private:
  std::string folder_ = own_folder() + "/temporary";
};

}  // namespace canhil::test
