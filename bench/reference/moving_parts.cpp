// The parts of the reference about what moves: the truth, and plants.
#include <fmt/format.h>

#include <string>
#include <tuple>
#include <utility>

#include "bench/plant/registry.hpp"
#include "bench/plant/setup.hpp"
#include "bench/plant/steered_heading.hpp"
#include "bench/reference/tables.hpp"
#include "bench/scenario/initial_error.hpp"
#include "bench/scenario/truth.hpp"

namespace canhil::reference {
namespace {

/// The keys of a table inside [truth].
std::vector<AskedKey> inner_keys_of_truth(const std::string& given, std::string_view table) {
  return in_table(explore(
                      [](std::string_view text) {
                        Section section = Section::parse(text, file);
                        scenario::read_truth(section, longest_run_us);
                      },
                      given, Depth::as_it_is),
                  table);
}

std::vector<AskedKey> keys_of_waypoint() {
  const std::string given = "trajectory = \"waypoints\"\n";
  auto keys = inner_keys_of_truth(given + "waypoint = [{}]\n", "waypoint[1]");
  for (AskedKey& one : keys) {
    if (one.key.required) one.in_place = {one.key.name == "north_m" ? "latitude_deg" : "longitude_deg"};
  }
  for (AskedKey& one : inner_keys_of_truth(given + "waypoint = [{ latitude_deg = 0 }]\n", "waypoint[1]")) {
    one.key.required = false;
    keys.push_back(std::move(one));
  }
  return keys;
}

std::vector<AskedKey> keys_of_sinusoid() {
  auto keys = inner_keys_of_truth("trajectory = \"rest\"\nvibration.sine = [{}]\n", "vibration.sine[1]");
  for (AskedKey& one : keys) {
    if (one.key.name == "phase_deg") one.key.fallback.clear();  // drawn
  }
  return keys;
}

}  // namespace

Part truth_part(const scenario::DbcVocabulary& contract) {
  Part part{
      .title = "Truth and initial errors",
      .about = "",
      .tables = {
          {.name = "[truth]",
           .about = "The flight of the carrier.",
           .keys = in_table(keys_of([](Section& section) { scenario::read_truth(section, longest_run_us); }),
                            "")},
          {.name = "[[truth.leg]]",
           .about =
               "A leg of the trajectory `legs`. What a leg does not give keeps the value of the leg before; "
               "a turn ends with its leg.",
           .keys = inner_keys_of_truth("trajectory = \"legs\"\nleg = [{}]\n", "leg[1]")},
          {.name = "[[truth.waypoint]]",
           .about = "A waypoint of the trajectory `waypoints`: by `north_m` and `east_m`, or by "
                    "`latitude_deg` and "
                    "`longitude_deg`. The vehicle passes it on a turn; it reaches the last one.",
           .keys = keys_of_waypoint()},
          {.name = "[[truth.vibration.sine]]",
           .about = "A vibration of one frequency, on top of a built-in trajectory. All runs have the same "
                    "phases, drawn "
                    "from the seed.",
           .keys = keys_of_sinusoid()},
          {.name = "[[truth.vibration.random]]",
           .about = "Random vibration in a band of frequencies.",
           .keys = inner_keys_of_truth("trajectory = \"rest\"\nvibration.random = [{}]\n",
                                       "vibration.random[1]")},
          {.name = "[truth.sea]",
           .about = "The motion of a vessel in waves, on top of a built-in trajectory: heave, horizontal "
                    "motion, roll "
                    "and pitch. `height_m` is then the mean height. All runs have the same waves, drawn from "
                    "the seed.",
           .keys = inner_keys_of_truth("trajectory = \"rest\"\nsea = {}\n", "sea")},
          {.name = "[initial_error]",
           .about =
               "The initial state that the bench sends to the target is the true state plus these errors.",
           .keys = keys_of([](Section& section) { scenario::read_initial_error(section); })}}};
  for (const scenario::PlantTable* plant : contract.plants) {
    const auto keys = keys_of([&](Section& root) {
      Section section = root.table(plant->key);
      plant->read(root, section, *contract.binding);
    });
    std::vector<std::string> tables{std::string(plant->key), fmt::format("{}.initial_error", plant->key)};
    for (const std::string_view table : plant->further_tables) tables.emplace_back(table);
    for (const std::string& table : tables) {
      auto own = in_table(keys, table);
      if (!own.empty())
        part.tables.push_back(
            {.name = fmt::format("[{}]", table), .about = std::string(plant->about), .keys = std::move(own)});
    }
  }
  return part;
}

Part plants_part() {
  AnyBinding binding;
  binding.reported = {{.name = "rudder.command", .si = "rad"}};
  const auto all =
      keys_of([&](Section& section) { plant::read_setup(section, binding); }, "kind = \"steered_heading\"\n");
  const auto of = [](const plant::Kind& kind) {
    return keys_of([&](Section& section) { std::ignore = kind.read(section); });
  };
  std::vector<AskedKey> common;
  const auto own = of(plant::steered_heading);
  for (const AskedKey& one : in_table(all, "")) {
    if (std::ranges::none_of(own, [&](const AskedKey& other) { return other.key.name == one.key.name; }))
      common.push_back(one);
  }
  Part part{.title = "Plant",
            .about =
                "What moves, and what the target's commands steer (plant.md). The names of the inputs and "
                "outputs, and the units of their values, are those of the kind.",
            .tables = {{.name = "[plant]", .about = "Keys of each kind.", .keys = std::move(common)},
                       {.name = "[plant.commands.INPUT]",
                        .about = "What steers an input; for example a rudder, whose values are angles.",
                        .keys = in_table(all, "commands.rudder")}}};
  for (const plant::Kind* kind : plant::kinds())
    part.tables.push_back(
        {.name = std::string(kind->key), .about = std::string(kind->meaning), .keys = of(*kind)});
  return part;
}

}  // namespace canhil::reference
