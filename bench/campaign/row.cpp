#include "bench/campaign/row.hpp"

#include <SQLiteCpp/VariadicBind.h>
#include <fmt/format.h>

#include <bit>
#include <limits>
#include <span>

#include "bench/campaign/database.hpp"
#include "bench/mapping/mapping.hpp"
#include "bench/world/hash.hpp"

namespace canhil::campaign {
namespace {

std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::int64_t hash_of(std::int64_t id, const Key& key, const drive::Ending& ending, std::string_view columns,
                     std::span<const std::uint8_t> samples, std::string_view judged) {
  return Digest()
      .add(id)
      .add(static_cast<std::int64_t>(key.variant))
      .add(static_cast<std::int64_t>(key.run))
      .add(static_cast<std::int64_t>(ending.kind))
      .add(ending.t_us)
      .add(ending.detail)
      .add(columns)
      .add(text_of(samples))
      .add(judged)
      .value();
}

Unfit damaged(const SQLite::Statement& row, std::string_view what) {
  return Unfit(fmt::format("row {} {}, expected the results of a run: the file is damaged",
                           row.getColumn(0).getInt64(), what));
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

void bind_row(SQLite::Statement& statement, std::uint64_t runs, const Finished& finished) {
  const auto& [variant, series] = finished;
  const Key key{.variant = variant, .run = series.run};
  const std::int64_t id = row_id(key, runs);
  const std::string columns = quantities::names(series.samples.layout());
  const auto samples = quantities::encode(series.samples);
  SQLite::bind(statement, id, static_cast<std::int64_t>(key.variant), static_cast<std::int64_t>(key.run),
               static_cast<std::int64_t>(series.ending.kind), series.ending.t_us, series.ending.detail,
               columns);
  // A null pointer would be stored as NULL, not as an empty blob.
  const void* bytes = samples.empty() ? "" : static_cast<const void*>(samples.data());
  statement.bind(8, bytes, static_cast<int>(samples.size()));
  statement.bind(9, series.judged);
  statement.bind(10, hash_of(id, key, series.ending, columns, samples, series.judged));
}

Key key_of(const SQLite::Statement& row, std::uint64_t runs) {
  const std::int64_t variant = row.getColumn(1), run = row.getColumn(2);
  const bool known = variant >= 0 && run >= 0 && static_cast<std::uint64_t>(run) < runs &&
                     static_cast<std::uint64_t>(variant) <=
                         static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) / runs;
  const Key key{.variant = static_cast<std::size_t>(variant), .run = static_cast<std::uint64_t>(run)};
  if (!known || row_id(key, runs) != row.getColumn(0).getInt64())
    throw damaged(row, fmt::format("is of run {} of variant {}", run, variant));
  return key;
}

Finished read_row(const SQLite::Statement& row, std::uint64_t runs) {
  const Key key = key_of(row, runs);
  const std::int64_t kind = row.getColumn(3);
  const std::string columns = row.getColumn(6);
  static const quantities::Samples none;
  const estimators::Estimator* estimator = estimators::telling(columns);
  const quantities::Layout* layout = columns.empty()        ? &none.layout()
                                     : estimator != nullptr ? &estimator->layout
                                                            : mapping::find_layout(columns);
  if (kind < 0 || kind > static_cast<std::int64_t>(drive::Ending::last_kind))
    throw damaged(row, fmt::format("has ending {}", kind));
  if (layout == nullptr) throw damaged(row, "has columns that no estimator reports");
  const SQLite::Column blob = row.getColumn(7);
  const std::span bytes(static_cast<const std::uint8_t*>(blob.getBlob()),
                        static_cast<std::size_t>(blob.getBytes()));
  drive::Ending ending{
      .kind = static_cast<drive::Ending::Kind>(kind), .t_us = row.getColumn(4), .detail = row.getColumn(5)};
  std::string judged = row.getColumn(8);
  if (hash_of(row.getColumn(0), key, ending, columns, bytes, judged) != row.getColumn(9).getInt64())
    throw damaged(row, "has another hash than its content");
  auto samples = quantities::decode(bytes, *layout);
  if (!samples) throw damaged(row, samples.error().message);
  return Finished{.variant = key.variant,
                  .series = {.run = key.run,
                             .ending = std::move(ending),
                             .samples = std::move(*samples),
                             .judged = std::move(judged)}};
}

}  // namespace canhil::campaign
