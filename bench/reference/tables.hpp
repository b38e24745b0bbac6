// Collects the keys that readers ask for, into tables of the reference.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "bench/reference/explore.hpp"
#include "bench/reference/parts.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::reference {

// A target with a DBC of its own, of which nothing is known.
struct AnyBinding final : scenario::Binding {
  AnyBinding() {
    any_sensor = true;
    channels.push_back({.name = "CHANNEL", .answers = true});
    flags.emplace_back("FLAG");
  }
};

using scenario::Section;

inline constexpr std::int64_t longest_run_us = 86'400'000'000;
inline constexpr std::string_view file = "reference";  // the file name in error messages, which are not shown

/// The keys that a reader of one section requests.
template <class ReadSection>
std::vector<AskedKey> keys_of(ReadSection read, const std::string& given = "") {
  return explore(
      [&](std::string_view text) {
        Section section = Section::parse(text, file);
        read(section);
      },
      given);
}

/// The keys of one table, without its nested tables.
inline std::vector<AskedKey> in_table(const std::vector<AskedKey>& keys, std::string_view table) {
  std::vector<AskedKey> own;
  std::ranges::copy_if(keys, std::back_inserter(own), [&](const AskedKey& one) {
    return one.key.table == table && !(one.key.type == "table" && one.key.meaning.empty());
  });
  return own;
}

/// The parts about what moves.
Part truth_part(const scenario::DbcVocabulary& contract);
Part plants_part();

}  // namespace canhil::reference
