#include "bench/campaign/store.hpp"

#include <SQLiteCpp/Transaction.h>
#include <SQLiteCpp/VariadicBind.h>
#include <fmt/format.h>

#include <charconv>

#include "bench/campaign/database.hpp"
#include "bench/drive/target_command.hpp"
#include "bench/processes/command.hpp"
#include "dbc/files/output_file.hpp"
#include "dbc/version/version.hpp"
#include "messages/canhil.hpp"

namespace canhil::campaign {
namespace {

constexpr int format = 7;
constexpr int any_format = 0x43484300;  // "CHC": canhil campaign
constexpr int application_id = any_format + '0' + format;

// identity.hash is a checksum over the row of `identity` and all sources.
std::string schema() {
  return fmt::format(
      "create table identity (campaign_hash text, dbc_hash text, program text, target text, runs integer, "
      "unrounded integer, hash integer);"
      "create table source (kind text, name text, content text);"
      "create table run ({});",
      row_schema);
}

std::string with_hash(std::string_view name, const std::string& program) {
  const auto file = drive::identify_file(program);
  return fmt::format("{}+{}", name, file ? file->sha256.substr(0, 16) : "unknown");
}

// The target's command, in which the name and the hash of each file replace the path of the file, so that
// folders do not matter.
std::string with_hashes(const std::string& target) {
  std::string text;
  const auto words = drive::target_words(target);
  for (std::size_t i = 0; words && i < words->size(); ++i) {
    const std::string& word = (*words)[i];
    const std::string path = i == 0 ? processes::program_path(word) : word;
    text += text.empty() ? "" : " ";
    text += i == 0 || drive::identify_file(path)
                ? with_hash(std::filesystem::path(path).filename().string(), path)
                : word;
  }
  return text;
}

std::int64_t hash_of(const Identity& identity, const Sources& sources) {
  Digest digest;
  digest.add(static_cast<std::int64_t>(identity.campaign_hash))
      .add(static_cast<std::int64_t>(identity.dbc_hash))
      .add(identity.program)
      .add(identity.target)
      .add(static_cast<std::int64_t>(identity.runs))
      .add(std::int64_t{identity.rounding == Rounding::none})
      .add(sources.file)
      .add(sources.text);
  for (const auto& [name, text] : sources.scenarios) digest.add(name).add(text);
  return digest.value();
}

// The sources as stored: file names without the campaign's folder.
Sources kept_of(const Sources& sources) {
  Sources kept = sources;
  kept.file = std::filesystem::path(sources.file).filename().string();
  return kept;
}

Unfit not_results() { return Unfit("is another kind of file, expected results of a campaign"); }

Unfit out_of_place(const SQLite::Statement& row) {
  return Unfit(fmt::format("row {} is out of its place, expected rows in order: the file is damaged",
                           row.getColumn(0).getInt64()));
}

void check_format(SQLite::Database& database) {
  const std::int64_t found = database.execAndGet("pragma application_id");
  const std::int64_t found_format = found - any_format - '0';
  if (found_format > 0 && found_format < format)
    throw Unfit(fmt::format("is of format {}, expected {}: it must be flown again", found_format, format));
  if (found != application_id) throw not_results();
  check_size(database);
  check_schema(database, schema());
}

Sources read_sources(const SQLite::Database& database) {
  SQLite::Statement row(database, "select kind, name, content from source");
  Sources sources;
  // A damaged file can repeat its rows without end. Each variant has a scenario, a mapping and a DBC at most.
  for (std::uint64_t rows = 0; row.executeStep(); ++rows) {
    if (rows > 3 * most_variants) throw not_results();
    if (row.getColumn(0).getString() == "campaign") {
      sources.file = row.getColumn(1).getString();
      sources.text = row.getColumn(2).getString();
    } else {
      sources.scenarios.emplace(row.getColumn(1).getString(), row.getColumn(2).getString());
    }
  }
  return sources;
}

}  // namespace

Identity identity_of(const Campaign& campaign, const std::string& target) {
  static const std::string program = with_hash(version_text(), "/proc/self/exe");
  return {.campaign_hash = campaign.hash,
          .dbc_hash = messages::dbc_hash,
          .rounding = campaign.rounding,
          .program = program,
          .target = with_hashes(target),
          .runs = campaign.runs};
}

std::string_view in_words(Rounding rounding) {
  return rounding == Rounding::none ? "without the bus's rounding" : "with the bus's rounding";
}

std::string_view in_words(const std::string& target) {
  return target.empty() ? "the bench's own device" : std::string_view(target);
}

std::string difference(const Identity& found, const Identity& expected) {
  if (found.campaign_hash != expected.campaign_hash) {
    return fmt::format("is of another campaign ({:016x}), expected {:016x}", found.campaign_hash,
                       expected.campaign_hash);
  }
  if (found.dbc_hash != expected.dbc_hash) {
    return fmt::format("is of another DBC ({:016x}), expected {:016x}", found.dbc_hash, expected.dbc_hash);
  }
  if (found.rounding != expected.rounding)
    return fmt::format("was flown {}, expected {}", in_words(found.rounding), in_words(expected.rounding));
  if (found.program != expected.program) {
    return fmt::format("is of another program ({}), expected {}", found.program, expected.program);
  }
  if (found.target != expected.target)
    return fmt::format("was flown against {}, expected {}", in_words(found.target),
                       in_words(expected.target));
  if (found.runs != expected.runs) {
    return fmt::format("is of a campaign of {} runs, expected {}", found.runs, expected.runs);
  }
  return {};
}

void Store::initialise(const Identity& identity, const Sources& sources) {
  SQLite::Transaction transaction(database_, SQLite::TransactionBehavior::IMMEDIATE);
  database_.exec(fmt::format("pragma application_id = {};{}", application_id, schema()));
  identity_ = identity;
  sources_ = kept_of(sources);
  SQLite::Statement insert(database_, "insert into identity values (?, ?, ?, ?, ?, ?, ?)");
  SQLite::bind(insert, fmt::format("{:016x}", identity.campaign_hash),
               fmt::format("{:016x}", identity.dbc_hash), identity.program, identity.target,
               static_cast<std::int64_t>(identity.runs), identity.rounding == Rounding::none,
               hash_of(identity_, sources_));
  insert.exec();
  SQLite::Statement source(database_, "insert into source values (?, ?, ?)");
  SQLite::bind(source, "campaign", sources_.file, sources_.text);
  source.exec();
  for (const auto& [name, text] : sources_.scenarios) {
    source.reset();
    SQLite::bind(source, "scenario", name, text);
    source.exec();
  }
  transaction.commit();
}

void Store::read_identity() {
  check_format(database_);
  SQLite::Statement row(
      database_, "select campaign_hash, dbc_hash, program, target, runs, unrounded, hash from identity");
  if (!row.executeStep()) throw not_results();
  const auto hash = [&](int column) {
    std::uint64_t value = 0;
    const std::string digits = row.getColumn(column);
    std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    return value;
  };
  identity_ = {.campaign_hash = hash(0),
               .dbc_hash = hash(1),
               .rounding = row.getColumn(5).getInt64() == 0 ? Rounding::as_on_the_bus : Rounding::none,
               .program = row.getColumn(2),
               .target = row.getColumn(3),
               .runs = static_cast<std::uint64_t>(row.getColumn(4).getInt64())};
  sources_ = read_sources(database_);
  if (identity_.runs == 0 || identity_.runs > most_runs ||
      hash_of(identity_, sources_) != row.getColumn(6).getInt64())
    throw Unfit(
        "what it says of its campaign has another hash, expected it as it was written: the file is damaged");
}

Result<Store> Store::create(const std::filesystem::path& path, const Identity& identity,
                            const Sources& sources) {
  if (std::filesystem::exists(std::filesystem::symlink_status(path))) {
    return failure(fmt::format("{}: exists already, expected a new file (or --resume)", path.string()));
  }
  if (auto created = create_new_file(path.string()); !created) return tl::unexpected(created.error());
  auto store = resume(path, identity, sources);
  if (!store) {  // a file without tables would block the next attempt
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    std::filesystem::remove(path.string() + "-journal", ignored);
  }
  return store;
}

Result<Store> Store::resume(const std::filesystem::path& path, const Identity& identity,
                            const Sources& sources) {
  auto database = open_database(path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  if (!database) return tl::unexpected(database.error());
  Store store(std::move(*database));
  return attempt(store.database_, [&] {
    // A committed transaction is on the disk. The lock is held until close(), so only one process can write
    // to a file.
    store.database_.exec(
        "pragma page_size = 4096; pragma auto_vacuum = none; pragma synchronous = normal;"
        "pragma locking_mode = exclusive; begin immediate; commit");
    if (SQLite::Statement(store.database_, "select 1 from sqlite_master").executeStep()) {
      store.read_identity();
      if (const std::string what = difference(store.identity_, identity); !what.empty()) throw Unfit(what);
    } else {
      store.initialise(identity, sources);
    }
    return std::move(store);
  });
}

Result<Store> Store::open(const std::filesystem::path& path) {
  auto database = open_database(path, SQLite::OPEN_READONLY);
  if (!database) return tl::unexpected(database.error());
  Store store(std::move(*database));
  return attempt(store.database_, [&] {
    store.read_identity();
    return std::move(store);
  });
}

Result<std::vector<Key>> Store::keys() const {
  return attempt(database_, [&] {
    SQLite::Statement row(database_, fmt::format("select {} from run order by id", key_columns));
    std::vector<Key> keys;
    while (row.executeStep()) {
      const Key key = key_of(row, identity_.runs);
      if (!keys.empty() && key <= keys.back()) throw out_of_place(row);
      keys.push_back(key);
    }
    return keys;
  });
}

Result<std::vector<RunSeries>> Store::load(std::size_t variant) const {
  return attempt(database_, [&] {
    SQLite::Statement row(
        database_, fmt::format("select {} from run where id >= ? and id < ? order by id", row_columns));
    SQLite::bind(row, row_id({variant, 0}, identity_.runs), row_id({variant + 1, 0}, identity_.runs));
    std::vector<RunSeries> runs;
    while (row.executeStep()) {
      auto [found, series] = read_row(row, identity_.runs);
      if (found != variant || (!runs.empty() && series.run <= runs.back().run)) throw out_of_place(row);
      runs.push_back(std::move(series));
    }
    return runs;
  });
}

Result<RunSeries> Store::load(const Key& key) const {
  return attempt(database_, [&] {
    SQLite::Statement row(database_, fmt::format("select {} from run where id = ?", row_columns));
    row.bind(1, row_id(key, identity_.runs));
    if (!row.executeStep()) throw Unfit(fmt::format("holds no run {}", key.run));
    Finished finished = read_row(row, identity_.runs);
    if (Key{.variant = finished.variant, .run = finished.series.run} != key) throw out_of_place(row);
    return std::move(finished.series);
  });
}

Result<void> Store::add(std::span<const Finished> runs) {
  return attempt(database_, [&] {
    SQLite::Transaction transaction(database_, SQLite::TransactionBehavior::IMMEDIATE);
    SQLite::Statement insert(database_, fmt::format("insert into run values ({})", row_places));
    for (const Finished& finished : runs) {
      bind_row(insert, identity_.runs, finished);
      insert.exec();
      insert.reset();
    }
    transaction.commit();
  });
}

void Store::close() { const SQLite::Database closed(std::move(database_)); }

}  // namespace canhil::campaign
