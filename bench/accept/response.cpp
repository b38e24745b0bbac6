#include "bench/accept/response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace canhil::accept {
namespace {

using checks::Outcome;

constexpr double least_move = 1.01;
constexpr double same_time_s = 1e-6;  // the resolution of a time on the bus

std::string with_unit(std::string_view unit) { return unit.empty() ? "" : fmt::format(" {}", unit); }

// Limits of the mean difference.
void judge_difference(const Move& move, const Series& here, const Series& there, Item& item) {
  const auto response = mean_difference(here, there, move.signal);
  if (!response) return;
  item.judgement.measurement.value = *response;
  if (*response >= move.by->first && *response <= move.by->second) item.outcome = Outcome::pass;
  item.measured = fmt::format("differs by {:.4g}{}", *response, with_unit(item.judgement.criterion.unit));
}

void judge_first(const Move& move, const Series& here, const Series& there, Item& item) {
  const auto first_s = first_difference(here, there, move.signal);
  if (first_s && std::abs(*first_s - *move.first_at_s) < same_time_s) item.outcome = Outcome::pass;
  item.measured = first_s ? fmt::format("first differs at {:g} s", *first_s) : "does not differ";
}

// The magnitude of the mean must be larger here, or there.
void judge_magnitude(const Move& move, const Series& here, const Series& there, Item& item) {
  const auto here_at = here.index_of(move.signal), there_at = there.index_of(move.signal);
  if (!here_at || !there_at) return;
  const double now = std::abs(here.mean(*here_at)), before = std::abs(there.mean(*there_at));
  const double limit = move.up ? before * least_move : before / least_move;
  if (move.up ? now > limit : now < limit) item.outcome = Outcome::pass;
  checks::Criterion& criterion = item.judgement.criterion;
  (move.up ? criterion.lower : criterion.upper) = checks::exclusive(limit);
  item.judgement.measurement.value = now;
  item.measured =
      fmt::format("mean magnitude {:.4g}{}, there {:.4g}", now, with_unit(criterion.unit), before);
}

std::string expected_of(const Move& move, std::string_view unit) {
  if (move.by)
    return fmt::format("{:g} to {:g}{} from flight '{}'", move.by->first, move.by->second, with_unit(unit),
                       move.flight);
  if (move.first_at_s)
    return fmt::format("the first difference from flight '{}' at {:g} s", move.flight, *move.first_at_s);
  return fmt::format("at least {:g} % {} than in flight '{}'", 100 * (least_move - 1),
                     move.up ? "more" : "less", move.flight);
}

}  // namespace

Item judge_move(const Move& move, const std::string& name, const Answers& answers, const Answers& others) {
  const Series* here = answers.find(move.message);
  const Series* there = others.find(move.message);
  const auto place = here == nullptr ? std::nullopt : here->index_of(move.signal);
  const std::string unit(place ? here->signals[*place]->unit : "");
  Item item{.name = fmt::format("{}: {}.{}", name, move.message, move.signal),
            .kind = "moves",
            .requirement = move.requirement,
            .outcome = Outcome::fail,
            .measured = "no answer has this signal",
            .expected = expected_of(move, unit)};
  item.judgement.criterion = {.quantity = fmt::format("{}.{}", move.message, move.signal), .unit = unit};
  if (move.by) {
    item.judgement.criterion.lower = checks::Limit{.value = move.by->first};
    item.judgement.criterion.upper = checks::Limit{.value = move.by->second};
  }
  if (here == nullptr || there == nullptr) return item;
  if (move.by)
    judge_difference(move, *here, *there, item);
  else if (move.first_at_s)
    judge_first(move, *here, *there, item);
  else
    judge_magnitude(move, *here, *there, item);
  return item;
}

}  // namespace canhil::accept
