#include "bench/campaign/row.hpp"

#include <fmt/format.h>

#include <bit>
#include <limits>
#include <optional>
#include <span>

#include "bench/world/hash.hpp"

namespace canhil::campaign {
namespace {

std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::int64_t hash_of(std::int64_t id, const Key& key, const drive::Ending& ending, std::string_view columns,
                     std::span<const std::uint8_t> samples) {
  return Digest()
      .add(id)
      .add(static_cast<std::int64_t>(key.variant))
      .add(static_cast<std::int64_t>(key.run))
      .add(static_cast<std::int64_t>(ending.kind))
      .add(ending.t_us)
      .add(ending.detail)
      .add(columns)
      .add(text_of(samples))
      .value();
}

/// A value of an enumeration from 0 to its last one; none: it is no such value.
template <class Enum>
std::optional<Enum> enumerator(std::int64_t value, Enum last) {
  if (value < 0 || value > static_cast<std::int64_t>(last)) return std::nullopt;
  return static_cast<Enum>(value);
}

auto damaged(const Statement& row, std::string_view what) {
  return failure(fmt::format("{}: row {} {}, expected results as they were written: the file is damaged",
                             row.file(), row.integer(0), what));
}

}  // namespace

std::int64_t row_id(const Key& key, std::uint64_t runs) {
  return static_cast<std::int64_t>(key.variant * runs + key.run);
}

Digest& Digest::add(std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  for (unsigned shift = 0; shift < 64; shift += 8) bytes_ += static_cast<char>(bits >> shift & 0xFFU);
  return *this;
}

Digest& Digest::add(std::string_view text) {
  add(static_cast<std::int64_t>(text.size()));
  bytes_ += text;
  return *this;
}

std::int64_t Digest::value() const { return std::bit_cast<std::int64_t>(world::fnv1a_64(bytes_)); }

void bind_row(Statement& statement, std::uint64_t runs, const Finished& finished) {
  const auto& [variant, series] = finished;
  const Key key{.variant = variant, .run = series.run};
  const std::int64_t id = row_id(key, runs);
  const std::string columns = quantities::names(series.samples.layout());
  const auto samples = quantities::encode(series.samples);
  statement.bind(1, id)
      .bind(2, static_cast<std::int64_t>(key.variant))
      .bind(3, static_cast<std::int64_t>(key.run))
      .bind(4, static_cast<std::int64_t>(series.ending.kind))
      .bind(5, series.ending.t_us)
      .bind(6, series.ending.detail)
      .bind(7, columns)
      .bind(8, samples)
      .bind(9, hash_of(id, key, series.ending, columns, samples));
}

Result<Key> key_of(const Statement& row, std::uint64_t runs) {
  const std::int64_t variant = row.integer(1), run = row.integer(2);
  const bool known = variant >= 0 && run >= 0 && static_cast<std::uint64_t>(run) < runs &&
                     static_cast<std::uint64_t>(variant) <=
                         static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) / runs;
  const Key key{.variant = static_cast<std::size_t>(variant), .run = static_cast<std::uint64_t>(run)};
  if (!known || row_id(key, runs) != row.integer(0))
    return damaged(row, fmt::format("is of run {} of variant {}", run, variant));
  return key;
}

Result<Finished> read_row(const Statement& row, std::uint64_t runs) {
  const auto key = key_of(row, runs);
  if (!key) return tl::unexpected(key.error());
  const auto kind = enumerator(row.integer(3), drive::Ending::last_kind);
  const std::string columns = row.text(6);
  const estimators::Estimator* estimator = estimators::telling(columns);
  if (!kind) return damaged(row, fmt::format("has ending {}", row.integer(3)));
  if (estimator == nullptr) return damaged(row, "has columns that no estimator tells");
  const std::span<const std::uint8_t> bytes = row.bytes(7);
  drive::Ending ending{.kind = *kind, .t_us = row.integer(4), .detail = row.text(5)};
  if (hash_of(row.integer(0), *key, ending, columns, bytes) != row.integer(8))
    return damaged(row, "has another hash than its content");
  auto samples = quantities::decode(bytes, estimator->layout);
  if (!samples) return damaged(row, samples.error().message);
  return Finished{.variant = key->variant,
                  .series = {.run = key->run, .ending = std::move(ending), .samples = std::move(*samples)}};
}

}  // namespace canhil::campaign
