#include "bench/campaign/store.hpp"

#include <fmt/format.h>

#include <charconv>

#include "bench/drive/program_file.hpp"
#include "messages/canhil.hpp"

namespace canhil::campaign {
namespace {

constexpr int format = 5;
constexpr int any_format = 0x43484300;  // "CHC": canhil campaign
constexpr int application_id = any_format + '0' + format;

// identity.hash: of its row and of all sources.
std::string schema() {
  return fmt::format(
      "create table identity (campaign_hash text, dbc_hash text, program text, runs integer, "
      "unrounded integer, hash integer);"
      "create table source (kind text, name text, content text);"
      "create table run ({});",
      row_schema);
}

std::string hash_of_this_program() {
  const auto own = drive::look_at_program("/proc/self/exe");
  return fmt::format("{}+{:016x}", CANHIL_VERSION, own ? own->hash : 0);
}

std::int64_t hash_of(const Identity& identity, const Sources& sources) {
  Digest digest;
  digest.add(static_cast<std::int64_t>(identity.campaign_hash))
      .add(static_cast<std::int64_t>(identity.dbc_hash))
      .add(identity.program)
      .add(static_cast<std::int64_t>(identity.runs))
      .add(std::int64_t{identity.rounding == Rounding::none})
      .add(sources.file)
      .add(sources.text);
  for (const auto& [name, text] : sources.scenarios) digest.add(name).add(text);
  return digest.value();
}

// As they are kept: without the folder in which the campaign was.
Sources kept_of(const Sources& sources) {
  Sources kept = sources;
  kept.file = std::filesystem::path(sources.file).filename().string();
  return kept;
}

auto not_results(const std::string& file) {
  return failure(fmt::format("{}: is another kind of file, expected results of a campaign", file));
}

auto out_of_place(const Statement& row) {
  return failure(fmt::format("{}: row {} is out of its place, expected rows in order: the file is damaged",
                             row.file(), row.integer(0)));
}

// Everything since BEGIN, or nothing.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) {}
  ~Transaction() {
    if (open_) static_cast<void>(database_.run("rollback"));
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  Result<void> begin() {
    return database_.run("begin immediate").map([&] { open_ = true; });
  }
  Result<void> commit() {
    return database_.run("commit").map([&] { open_ = false; });
  }

 private:
  Database& database_;
  bool open_ = false;
};

}  // namespace

Identity identity_of(const Campaign& campaign) {
  static const std::string program = hash_of_this_program();
  return {.campaign_hash = campaign.hash,
          .dbc_hash = messages::dbc_hash,
          .rounding = campaign.rounding,
          .program = program,
          .runs = campaign.runs};
}

std::string_view in_words(Rounding rounding) {
  return rounding == Rounding::none ? "without the bus's rounding" : "with the bus's rounding";
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
  if (found.runs != expected.runs) {
    return fmt::format("is of a campaign of {} runs, expected {}", found.runs, expected.runs);
  }
  return {};
}

Result<Store> Store::open_to_write(const std::filesystem::path& path) {
  auto database = Database::open(path, Database::Access::create);
  if (!database) return tl::unexpected(database.error());
  // A transaction is on the disk when it is committed. The lock is held until close(): one writer a file.
  if (auto set =
          database->run("pragma page_size = 4096; pragma auto_vacuum = none; pragma synchronous = normal;"
                        "pragma locking_mode = exclusive; begin immediate; commit");
      !set) {
    return tl::unexpected(set.error());
  }
  return Store(std::move(*database));
}

Result<bool> Store::blank() const {
  auto tables = database_.prepare("select 1 from sqlite_master");
  if (!tables) return tl::unexpected(tables.error());
  return tables->step().map([](bool found) { return !found; });
}

Result<void> Store::initialise(const Identity& identity, const Sources& sources) {
  Transaction transaction(database_);
  if (auto begun = transaction.begin(); !begun) return begun;
  if (auto made = database_.run(fmt::format("pragma application_id = {};{}", application_id, schema()));
      !made) {
    return made;
  }
  const Sources kept = kept_of(sources);
  auto insert = database_.prepare("insert into identity values (?, ?, ?, ?, ?, ?)");
  if (!insert) return tl::unexpected(insert.error());
  insert->bind(1, fmt::format("{:016x}", identity.campaign_hash))
      .bind(2, fmt::format("{:016x}", identity.dbc_hash))
      .bind(3, identity.program)
      .bind(4, static_cast<std::int64_t>(identity.runs))
      .bind(5, std::int64_t{identity.rounding == Rounding::none})
      .bind(6, hash_of(identity, kept));
  if (auto done = insert->step(); !done) return tl::unexpected(done.error());
  auto source = database_.prepare("insert into source values (?, ?, ?)");
  if (!source) return tl::unexpected(source.error());
  source->bind(1, "campaign").bind(2, kept.file).bind(3, kept.text);
  if (auto done = source->step(); !done) return tl::unexpected(done.error());
  for (const auto& [name, text] : kept.scenarios) {
    source->reset();
    source->bind(1, "scenario").bind(2, name).bind(3, text);
    if (auto done = source->step(); !done) return tl::unexpected(done.error());
  }
  source->reset();
  insert->reset();
  identity_ = identity;
  return transaction.commit();
}

Result<void> Store::check_format() const {
  auto id = database_.prepare("pragma application_id");
  if (!id) return tl::unexpected(id.error());
  const auto known = id->step();
  if (!known) return tl::unexpected(known.error());
  const std::int64_t found = *known ? id->integer(0) : 0;
  const std::int64_t found_format = found - any_format - '0';
  if (found_format > 0 && found_format < format)
    return failure(fmt::format("{}: is of format {}, expected {}: it must be flown again", database_.file(),
                               found_format, format));
  if (found != application_id) return not_results(database_.file());
  return database_.check_size();
}

Result<void> Store::read_identity() {
  if (auto known = check_format(); !known) return known;
  auto row =
      database_.prepare("select campaign_hash, dbc_hash, program, runs, unrounded, hash from identity");
  if (!row) return tl::unexpected(row.error());
  const auto there = row->step();
  if (!there) return tl::unexpected(there.error());
  if (!*there) return not_results(database_.file());
  const auto hash = [&](int column) {
    std::uint64_t value = 0;
    const std::string digits = row->text(column);
    std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    return value;
  };
  identity_ = {.campaign_hash = hash(0),
               .dbc_hash = hash(1),
               .rounding = row->integer(4) == 0 ? Rounding::as_on_the_bus : Rounding::none,
               .program = row->text(2),
               .runs = static_cast<std::uint64_t>(row->integer(3))};
  const auto kept = sources();
  if (!kept) return tl::unexpected(kept.error());
  if (identity_.runs == 0 || hash_of(identity_, *kept) != row->integer(5))
    return failure(
        fmt::format("{}: what it says of its campaign has another hash, expected it as it was written: the "
                    "file is damaged",
                    database_.file()));
  return {};
}

Result<Store> Store::create(const std::filesystem::path& path, const Identity& identity,
                            const Sources& sources) {
  if (std::filesystem::exists(std::filesystem::symlink_status(path))) {
    return failure(fmt::format("{}: exists already, expected a new file (or --resume)", path.string()));
  }
  auto store = resume(path, identity, sources);
  if (!store) {  // a file without tables would be in the way of the next try
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    std::filesystem::remove(path.string() + "-journal", ignored);
  }
  return store;
}

Result<Store> Store::resume(const std::filesystem::path& path, const Identity& identity,
                            const Sources& sources) {
  auto store = open_to_write(path);
  if (!store) return store;
  const auto blank = store->blank();
  if (!blank) return tl::unexpected(blank.error());
  if (*blank) {
    if (auto made = store->initialise(identity, sources); !made) return tl::unexpected(made.error());
    return store;
  }
  if (auto read = store->read_identity(); !read) return tl::unexpected(read.error());
  if (const std::string what = difference(store->identity_, identity); !what.empty()) {
    return failure(fmt::format("{}: {}", path.string(), what));
  }
  return store;
}

Result<Store> Store::open(const std::filesystem::path& path) {
  auto database = Database::open(path, Database::Access::read);
  if (!database) return tl::unexpected(database.error());
  Store store(std::move(*database));
  if (auto read = store.read_identity(); !read) return tl::unexpected(read.error());
  return store;
}

Result<Sources> Store::sources() const {
  auto row = database_.prepare("select kind, name, content from source");
  if (!row) return tl::unexpected(row.error());
  Sources sources;
  while (true) {
    const auto there = row->step();
    if (!there) return tl::unexpected(there.error());
    if (!*there) return sources;
    if (row->text(0) == "campaign") {
      sources.file = row->text(1);
      sources.text = row->text(2);
    } else {
      sources.scenarios.emplace(row->text(1), row->text(2));
    }
  }
}

Result<std::vector<Key>> Store::keys() const {
  auto row = database_.prepare(fmt::format("select {} from run order by id", key_columns));
  if (!row) return tl::unexpected(row.error());
  std::vector<Key> keys;
  while (true) {
    const auto there = row->step();
    if (!there) return tl::unexpected(there.error());
    if (!*there) return keys;
    const auto key = key_of(*row, identity_.runs);
    if (!key) return tl::unexpected(key.error());
    if (!keys.empty() && *key <= keys.back()) return out_of_place(*row);
    keys.push_back(*key);
  }
}

Result<std::vector<RunSeries>> Store::load(std::size_t variant) const {
  auto row =
      database_.prepare(fmt::format("select {} from run where id >= ? and id < ? order by id", row_columns));
  if (!row) return tl::unexpected(row.error());
  row->bind(1, row_id({variant, 0}, identity_.runs)).bind(2, row_id({variant + 1, 0}, identity_.runs));
  std::vector<RunSeries> runs;
  while (true) {
    const auto there = row->step();
    if (!there) return tl::unexpected(there.error());
    if (!*there) return runs;
    auto finished = read_row(*row, identity_.runs);
    if (!finished) return tl::unexpected(finished.error());
    auto& [found, series] = *finished;
    if (found != variant || (!runs.empty() && series.run <= runs.back().run)) return out_of_place(*row);
    runs.push_back(std::move(series));
  }
}

Result<RunSeries> Store::load(const Key& key) const {
  auto row = database_.prepare(fmt::format("select {} from run where id = ?", row_columns));
  if (!row) return tl::unexpected(row.error());
  row->bind(1, row_id(key, identity_.runs));
  const auto there = row->step();
  if (!there) return tl::unexpected(there.error());
  if (!*there) return failure(fmt::format("{}: holds no run {}", database_.file(), key.run));
  auto finished = read_row(*row, identity_.runs);
  if (!finished) return tl::unexpected(finished.error());
  if (Key{.variant = finished->variant, .run = finished->series.run} != key) return out_of_place(*row);
  return std::move(finished->series);
}

Result<void> Store::add(std::span<const Finished> runs) {
  Transaction transaction(database_);
  if (auto begun = transaction.begin(); !begun) return begun;
  auto insert = database_.prepare(fmt::format("insert into run values ({})", row_places));
  if (!insert) return tl::unexpected(insert.error());
  for (const Finished& finished : runs) {
    bind_row(*insert, identity_.runs, finished);
    if (auto done = insert->step(); !done) return tl::unexpected(done.error());
    insert->reset();
  }
  return transaction.commit();
}

Result<void> Store::close() { return database_.close(); }

}  // namespace canhil::campaign
