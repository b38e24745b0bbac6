// Reproduces a paper with two runs per variant: reads and runs every campaign, draws every figure.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "bench/papers/paper.hpp"
#include "tests/own_folder.hpp"

namespace canhil::papers {

inline const std::atomic<bool> go_on = false;

inline Request request(const char* paper, const char* folder) {
  Request request;
  request.paper = paper;
  request.folder = std::filesystem::path(test::own_folder()) / folder;
  request.runs = 2;
  request.progress = [](std::string_view, std::size_t, std::size_t) {};
  return request;
}

struct Written {
  std::string html, text;
};

/// Reproduces the paper and writes its page to a new folder. Returns the page and the tables for a terminal.
inline Written reproduced(const Request& asked) {
  std::filesystem::remove_all(asked.folder);
  const auto reproduced = reproduce(asked, go_on);
  if (!reproduced) {
    ADD_FAILURE() << reproduced.error().message;
    return {};
  }
  EXPECT_NE(reproduced->outcome, Outcome::interrupted);
  EXPECT_NE(reproduced->outcome, Outcome::bars_missed) << "by two runs";
  std::ostringstream content;
  content << std::ifstream(reproduced->page).rdbuf();
  return {.html = content.str(), .text = reproduced->text};
}

inline Written reproduced(const char* paper, const char* folder) {
  return reproduced(request(paper, folder));
}

inline std::string complaint(const Request& asked) {
  const auto reproduced = reproduce(asked, go_on);
  return reproduced ? "no error" : reproduced.error().message;
}

}  // namespace canhil::papers
