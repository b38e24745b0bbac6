// What the rest of a scenario knows of its plant (bench/plant reads it).
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace canhil::plant {
struct Setup;
}

namespace canhil::scenario {

struct PlantFacts {
  struct Output {
    std::string name;    ///< as a true value: "plant.rudder"
    std::string si;      ///< SI unit; empty: a plain number
    bool turns = false;  ///< an angle: values that differ by a full turn are equal
  };
  std::shared_ptr<const plant::Setup> setup{};  ///< null: the scenario has no plant
  std::vector<Output> outputs{};
  std::vector<std::string> steered{};  ///< the inputs that the target commands
  bool moves_the_carrier = false;
};

}  // namespace canhil::scenario
