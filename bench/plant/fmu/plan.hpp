// Runs of a plant that is an FMU.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bench/plant/fmu/archive.hpp"
#include "bench/plant/fmu/description.hpp"
#include "bench/plant/plant.hpp"
#include "dbc/files/temporary_folder.hpp"

namespace canhil::plant::fmu {

/// An element of an input or output: its value in SI, and in the FMU.
struct Element {
  std::string name;
  Type type = Type::float64;
  Conversion conversion{};

  [[nodiscard]] double to_si(double value) const;
  /// The value that the FMU gets: integers are rounded, for a boolean 0 is false. Error, one phrase: the type
  /// cannot hold it.
  [[nodiscard]] Result<double> from_si(double si) const;
};

/// What all runs of a plan share.
struct FmuSettings {
  Setup setup{};  ///< its library is a path in the archive
  std::vector<Element> inputs{}, outputs{};
  bool in_process = false;
  std::chrono::milliseconds patience{};  ///< for an answer of the FMU's process
  bool step_may_vary = false;
  double internal_step_s = 0;  ///< 0: none
};

class FmuPlan final : public Plan {
 public:
  FmuPlan(FmuSettings settings, Archive archive)
      : settings_(std::make_shared<const FmuSettings>(std::move(settings))), archive_(std::move(archive)) {}

  [[nodiscard]] Result<std::unique_ptr<Plant>> make(const Draw& draw) const override;

 private:
  /// All runs use one folder. It exists from the first run until the plan and the last run have ended.
  [[nodiscard]] Result<std::shared_ptr<const TemporaryFolder>> unpacked() const;

  std::shared_ptr<const FmuSettings> settings_;
  Archive archive_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const TemporaryFolder> folder_;
};

}  // namespace canhil::plant::fmu
