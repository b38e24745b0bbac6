#include "bench/live/terminal.hpp"

#include <curses.h>
#include <unistd.h>

#include <array>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <optional>
#include <thread>

#include "bench/live/screen.hpp"

namespace canhil::live {
namespace {

// Redirects standard error to a file; otherwise the text would be written across the screen.
class HeldErrors {
 public:
  HeldErrors() : before_(dup(STDERR_FILENO)), file_(std::tmpfile()) {
    std::fflush(stderr);
    if (file_ != nullptr) dup2(fileno(file_), STDERR_FILENO);
  }
  ~HeldErrors() {
    std::fflush(stderr);
    dup2(before_, STDERR_FILENO);
    close(before_);
    if (file_ == nullptr) return;
    std::rewind(file_);
    std::array<char, 4096> part{};
    while (const std::size_t size = std::fread(part.data(), 1, part.size(), file_))
      std::fwrite(part.data(), 1, size, stderr);
    std::fclose(file_);
  }
  HeldErrors(const HeldErrors&) = delete;
  HeldErrors& operator=(const HeldErrors&) = delete;

 private:
  int before_;
  std::FILE* file_;
};

class Terminal final : public Display {
 public:
  explicit Terminal(SCREEN* screen) : screen_(screen) {
    cbreak();  // Ctrl-C still sends a signal
    noecho();
    curs_set(0);
    nodelay(stdscr, TRUE);
    keypad(stdscr, TRUE);
    if (has_colors() && start_color() == OK && use_default_colors() == OK) {
      init_pair(1, COLOR_GREEN, -1);
      init_pair(2, COLOR_RED, -1);
      init_pair(3, COLOR_YELLOW, -1);
    }
  }
  ~Terminal() override {
    endwin();
    delscreen(screen_);
  }

  void show(const Snapshot& snapshot) override {
    if (!paused_ || !shown_) shown_ = snapshot;
    draw();
  }
  void run_for(std::chrono::milliseconds time) override {
    std::this_thread::sleep_for(time);
    for (int key = getch(); key != ERR; key = getch()) {
      if (key == ' ') paused_ = !paused_;
      if (key == ' ' || key == KEY_RESIZE) draw();
    }
  }

 private:
  void draw() {
    if (!shown_) return;
    int rows = 0, columns = 0;
    getmaxyx(stdscr, rows, columns);
    erase();
    int row = 0;
    for (const ScreenLine& line :
         screen_of(*shown_, static_cast<std::size_t>(rows), static_cast<std::size_t>(columns), paused_)) {
      constexpr std::array looks{A_NORMAL, A_BOLD, COLOR_PAIR(1), COLOR_PAIR(2) | A_BOLD, COLOR_PAIR(3)};
      attrset(static_cast<int>(looks[static_cast<std::size_t>(line.look)]));
      mvaddnstr(row++, 0, line.text.data(), static_cast<int>(line.text.size()));
    }
    refresh();
  }

  HeldErrors errors_;
  SCREEN* screen_;
  std::optional<Snapshot> shown_;
  bool paused_ = false;
};

}  // namespace

Result<std::unique_ptr<Display>> open_terminal() {
  if (isatty(STDOUT_FILENO) == 0) return failure("--tui: standard output is no terminal, expected one");
  std::setlocale(LC_CTYPE, "");  // names may be UTF-8; number formats do not change
  SCREEN* screen = newterm(nullptr, stdout, stdin);
  if (screen == nullptr)
    return failure("--tui: TERM names no terminal that can be drawn on, expected one such as xterm");
  return std::make_unique<Terminal>(screen);
}

}  // namespace canhil::live
