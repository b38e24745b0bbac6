#include "bench/plant/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace canhil::plant {
namespace {

world::PlantRecord record_for(const Setup& setup) {
  std::vector<world::PlantRecord::Column> columns;
  for (const Variable& one : setup.plan->outputs)
    columns.push_back({.name = setup.shown(one), .turns = one.turns, .steps = one.steps});
  return world::PlantRecord(std::move(columns));
}

// The expressions of the motion use outputs of the plant only, so this flight is never looked at.
const world::FlightRecord& no_flight() {
  static const world::FlightRecord none({}, 0, 1);
  return none;
}

}  // namespace

Result<std::unique_ptr<Simulation>> Simulation::begin(const Setup& setup, const Draw& draw,
                                                      const Carrier& carrier) {
  auto plant = setup.plan->make(draw);
  if (!plant) return tl::unexpected(plant.error());
  const bool with_sensors = setup.plan->steps_with_sensors && draw.sensors_us > 0;
  const std::int64_t step_us = with_sensors ? draw.sensors_us : setup.plan->step_us;
  std::unique_ptr<Simulation> simulation(new Simulation(setup, std::move(*plant), step_us, carrier));
  if (simulation->failure_) return failure(*simulation->failure_);
  return simulation;
}

Simulation::Simulation(const Setup& setup, std::unique_ptr<Plant> plant, std::int64_t step_us,
                       const Carrier& carrier)
    : setup_(setup),
      plant_(std::move(plant)),
      step_us_(step_us),
      end_us_(carrier.duration_us),
      record_(record_for(setup)),
      next_(setup.commands.size(), 0) {
  for (const Command& one : setup.commands) {
    record_.commands.push_back(
        {.input = setup.plan->inputs[one.input].name, .delay_us = one.delay_us, .step_us = step_us});
  }
  if (!observe() || !setup.moves_the_carrier()) return;
  path_ = std::make_shared<world::GrownPath>(point());
  flight_.emplace(world::Flight{.start = carrier.start, .motion = world::Grown{path_}}, carrier.duration_us,
                  carrier.interval_us);
}

void Simulation::give(std::size_t command, const world::Given& given) {
  if (std::isfinite(given.value))
    record_.commands[command].given.push_back(given);
  else
    ++record_.commands[command].invalid;
}

void Simulation::guide(std::int64_t from_us, std::span<const double> inputs) {
  if (!plant_->guide(from_us, inputs)) ++record_.late;
}

std::vector<double> Simulation::inputs_at(std::int64_t t_us) {
  std::vector<double> inputs = setup_.start;
  for (std::size_t i = 0; i < record_.commands.size(); ++i) {
    const Command& command = setup_.commands[i];
    world::CommandRecord& record = record_.commands[i];
    while (next_[i] < record.given.size() && record.given[next_[i]].t_us + command.delay_us <= t_us)
      ++next_[i];
    if (next_[i] == 0) {
      record.missing_us.push_back(t_us);
      continue;
    }
    const world::Given& newest = record.given[next_[i] - 1];
    const bool too_old = command.timeout_us && t_us - newest.t_us - command.delay_us > *command.timeout_us;
    if (too_old) record.missing_us.push_back(t_us);
    inputs[command.input] = too_old ? command.after_timeout.value_or(newest.value) : newest.value;
  }
  return inputs;
}

// Records the outputs, at the end of the motion if it ended. Returns false if one is not finite.
bool Simulation::observe() {
  record_.ended_us = plant_->ended_us();
  if (record_.ended_us) {
    t_us_ = *record_.ended_us;
    if (!record_.times_us().empty() && record_.times_us().back() == t_us_) return true;
  }
  const auto outputs = plant_->outputs();
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (std::isfinite(outputs[i])) continue;
    failure_ = fmt::format("the plant '{}' has no finite value of '{}' at t={:.3f} s", setup_.kind,
                           setup_.plan->outputs[i].name, 1e-6 * static_cast<double>(t_us_));
    return false;
  }
  record_.add(t_us_, outputs);
  return true;
}

void Simulation::move() {
  if (!failure_) {
    const world::GrownPath::Point now = point();
    if (now.v_eb_n.allFinite() && now.C_bn.allFinite()) return path_->add(now);
    failure_ = fmt::format("the motion of the plant '{}' is not finite at t={:.3f} s", setup_.kind,
                           1e-6 * static_cast<double>(t_us_));
  }
  const world::Movement last = path_->movement(1e-6 * static_cast<double>(path_->end_us()));
  path_->add({.t_us = t_us_, .v_eb_n = last.v_eb_n, .C_bn = last.C_bn});
}

world::GrownPath::Point Simulation::point() const {
  const world::Truths truths{.flight = no_flight(), .plants = {&record_}};
  std::array<double, motion_values.size()> now{};
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (setup_.motion[i]) now[i] = setup_.motion[i]->at(truths, t_us_).value_or(std::nan(""));
  }
  return {.t_us = t_us_,
          .v_eb_n = {now[3], now[4], now[5]},
          .C_bn = world::C_bn_from({.roll = now[0], .pitch = now[1], .heading = now[2]})};
}

void Simulation::advance(std::int64_t t_us) {
  using Clock = std::chrono::steady_clock;
  const std::int64_t until_us = std::min(t_us, end_us_) - (setup_.plan->never_ahead ? step_us_ - 1 : 0);
  while (t_us_ < until_us && !record_.ended_us) {
    const std::int64_t from_us = t_us_;
    t_us_ += step_us_;
    if (!failure_) {
      const std::vector<double> inputs = inputs_at(from_us);
      const auto begun = Clock::now();
      const auto stepped = plant_->step(from_us, t_us_, inputs);
      record_.longest_step_s =
          std::max(record_.longest_step_s, std::chrono::duration<double>(Clock::now() - begun).count());
      if (!stepped) failure_ = stepped.error().message;
    }
    if (!failure_) observe();
    if (flight_) move();
  }
  if (flight_) flight_->follow();
}

std::optional<std::string> why_failed(std::span<Simulation* const> plants) {
  for (const Simulation* one : plants) {
    if (one->why_failed()) return one->why_failed();
  }
  return std::nullopt;
}

}  // namespace canhil::plant
