// SPDX-License-Identifier: MIT
#include "shell/pseudo_terminal.h"

#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <utility>

namespace tunica::shell {

namespace {

constexpr size_t height = 40;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::string joined(const std::vector<std::string>& characters) {
  std::string text;
  for (const auto& each : characters) text += each;
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

size_t number(const std::string& parameters, size_t otherwise) {
  return parameters.empty() ? otherwise : std::strtoul(parameters.c_str(), nullptr, 10);
}

}  // namespace

// --- Screen

std::vector<std::string>& Screen::row() {
  if (lines_.size() <= y_) lines_.resize(y_ + 1);
  return lines_[y_];
}

void Screen::put(const std::string& character) {
  if (x_ >= static_cast<size_t>(width_)) {
    x_ = 0;
    ++y_;
  }
  auto& line = row();
  if (line.size() <= x_) line.resize(x_ + 1, " ");
  line[x_++] = character;
  last_ = character;
}

void Screen::scroll(size_t from, long count) {
  if (lines_.size() < bottom_) lines_.resize(bottom_);
  for (; count > 0; --count) {
    lines_.erase(lines_.begin() + static_cast<long>(from));
    lines_.insert(lines_.begin() + static_cast<long>(bottom_) - 1, std::vector<std::string>());
  }
  for (; count < 0; ++count) {
    lines_.erase(lines_.begin() + static_cast<long>(bottom_) - 1);
    lines_.insert(lines_.begin() + static_cast<long>(from), std::vector<std::string>());
  }
}

void Screen::mode(const std::string& parameters, bool on) {
  if (parameters != "?1049" || on == alternate_) return;
  alternate_ = on;
  if (on) {
    normal_lines_ = std::exchange(lines_, std::vector<std::vector<std::string>>(1));
    normal_y_ = std::exchange(y_, 0);
    normal_x_ = std::exchange(x_, 0);
  } else {
    lines_ = std::move(normal_lines_);
    y_ = normal_y_;
    x_ = normal_x_;
  }
}

void Screen::sequence(const std::string& parameters, char final) {
  if (final == 'h' || final == 'l') return mode(parameters, final == 'h');
  auto& line = row();
  const size_t count = number(parameters, 1);
  switch (final) {
    case 'H': {
      const size_t semicolon = parameters.find(';');
      y_ = std::max<size_t>(1, number(parameters.substr(0, semicolon), 1)) - 1;
      x_ = semicolon == std::string::npos ? 0 : std::max<size_t>(1, number(parameters.substr(semicolon + 1), 1)) - 1;
      break;
    }
    case 'd':
      y_ = count - 1;
      break;
    case 'b':
      for (size_t i = 0; i < count; ++i) put(std::string(last_));
      break;
    case 'L':
      scroll(y_, -static_cast<long>(count));
      break;
    case 'M':
      scroll(y_, static_cast<long>(count));
      break;
    case 'r': {
      const size_t semicolon = parameters.find(';');
      top_ = number(parameters.substr(0, semicolon), 1) - 1;
      bottom_ = semicolon == std::string::npos ? height : number(parameters.substr(semicolon + 1), height);
      y_ = x_ = 0;
      break;
    }
    case 'X':
      for (size_t i = x_; i < std::min(line.size(), x_ + count); ++i) line[i] = " ";
      break;
    case 'm':
      coloured_ = coloured_ || !(parameters.empty() || parameters == "0");
      break;
    case 'K':
      if (parameters.empty() || parameters == "0") line.resize(std::min(line.size(), x_));
      if (parameters == "1") std::fill_n(line.begin(), std::min(line.size(), x_ + 1), " ");
      break;
    case 'J':
      if (parameters == "2") {
        lines_.clear();
        break;
      }
      line.resize(std::min(line.size(), x_));
      lines_.resize(y_ + 1);
      break;
    case 'C':
      x_ += count;
      break;
    case 'D':
      x_ -= std::min(x_, count);
      break;
    case 'A':
      y_ -= std::min(y_, count);
      break;
    case 'B':
      y_ += count;
      break;
    case 'G':
      x_ = count - 1;
      break;
    case 'P':
      if (x_ < line.size())
        line.erase(line.begin() + static_cast<long>(x_),
                   line.begin() + static_cast<long>(std::min(line.size(), x_ + count)));
      break;
    case '@':
      if (x_ < line.size()) line.insert(line.begin() + static_cast<long>(x_), count, " ");
      break;
    default:
      break;
  }
}

void Screen::write(const std::string& more) {
  const std::string bytes = unfinished_ + more;
  unfinished_.clear();
  for (size_t i = 0; i < bytes.size();) {
    const auto c = static_cast<unsigned char>(bytes[i]);
    if (c == '\033') {
      if (i + 1 < bytes.size() && bytes[i + 1] != '[') {
        if (bytes[i + 1] == 'M' && alternate_ && y_ == top_)
          scroll(top_, -1);
        else if (bytes[i + 1] == 'M')
          y_ -= std::min<size_t>(y_, 1);
        i += bytes[i + 1] == '(' || bytes[i + 1] == ')' ? 3 : 2;
        continue;
      }
      const size_t end = bytes.find_first_not_of("0123456789;?<=>", i + 2);
      if (i + 1 >= bytes.size() || end == std::string::npos) {
        unfinished_ = bytes.substr(i);
        return;
      }
      sequence(bytes.substr(i + 2, end - i - 2), bytes[end]);
      i = end + 1;
      continue;
    }
    if (c == '\r') {
      x_ = 0;
    } else if (c == '\n' && alternate_ && y_ + 1 == bottom_) {
      scroll(top_, 1);
    } else if (c == '\n') {
      ++y_;
      row();
    } else if (c == '\b') {
      x_ -= std::min<size_t>(x_, 1);
    } else if (c == '\t') {
      x_ = (x_ / 8 + 1) * 8;
    } else if (c >= 0x20) {
      const size_t length = c < 0x80 ? 1 : c < 0xE0 ? 2 : c < 0xF0 ? 3 : 4;
      if (i + length > bytes.size()) {
        unfinished_ = bytes.substr(i);
        return;
      }
      put(bytes.substr(i, length));
      i += length;
      continue;
    }
    ++i;
  }
}

std::string Screen::text() const {
  std::string text;
  for (const auto& line : lines_) text += joined(line) + "\n";
  return text;
}

size_t Screen::row_start() const {
  size_t start = 0;
  for (size_t i = 0; i < y_ && i < lines_.size(); ++i) start += joined(lines_[i]).size() + 1;
  return start;
}

std::string Screen::line() const { return y_ < lines_.size() ? joined(lines_[y_]) : ""; }

// --- The program

PseudoTerminal::PseudoTerminal(const std::vector<std::string>& command,
                               const std::map<std::string, std::string>& environment, int width)
    : screen_(width) {
  winsize size{};
  size.ws_col = static_cast<unsigned short>(width);
  size.ws_row = height;
  process_ = forkpty(&terminal_, nullptr, nullptr, &size);
  if (process_ != 0) return;
  for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> arguments;
  for (const auto& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  _exit(127);
}

PseudoTerminal::~PseudoTerminal() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  if (terminal_ >= 0) close(terminal_);
}

bool PseudoTerminal::read_some(double seconds) {
  pollfd ready{terminal_, POLLIN, 0};
  if (poll(&ready, 1, static_cast<int>(seconds * 1000)) <= 0) return false;
  char buffer[4096];
  const ssize_t count = read(terminal_, buffer, sizeof buffer);
  if (count <= 0) return false;
  const std::string more(buffer, static_cast<size_t>(count));
  bytes_ += more;
  screen_.write(more);
  return true;
}

void PseudoTerminal::type(const std::string& keys) {
  mark_ = screen_.row_start();
  row_ = static_cast<long>(screen_.row_number());
  if (::write(terminal_, keys.data(), keys.size()) < 0) std::abort();
}

bool PseudoTerminal::shows(const std::string& text, double seconds) {
  const auto start = Clock::now();
  for (;;) {
    const std::string all = screen_.text();
    if (all.find(text, std::min(mark_, all.size())) != std::string::npos) return true;
    if (seconds_since(start) > seconds) return false;
    read_some(0.05);
  }
}

bool PseudoTerminal::displays(const std::string& text, double seconds) {
  const auto start = Clock::now();
  while (screen_.text().find(text) == std::string::npos) {
    if (seconds_since(start) > seconds) return false;
    read_some(0.05);
  }
  return true;
}

bool PseudoTerminal::hides(const std::string& text, double seconds) {
  const auto start = Clock::now();
  while (screen_.text().find(text) != std::string::npos) {
    if (seconds_since(start) > seconds) return false;
    read_some(0.05);
  }
  return true;
}

bool PseudoTerminal::stands_at(const std::string& line, double seconds) {
  const auto start = Clock::now();
  while (screen_.line() != line || static_cast<long>(screen_.row_number()) <= row_) {
    if (seconds_since(start) > seconds) return false;
    read_some(0.05);
  }
  return true;
}

void PseudoTerminal::watch(double seconds) {
  const auto start = Clock::now();
  while (seconds_since(start) < seconds) read_some(0.02);
}

int PseudoTerminal::exit_code(double seconds) {
  const auto start = Clock::now();
  int status = 0;
  while (waitpid(process_, &status, WNOHANG) == 0) {
    if (seconds_since(start) > seconds) return -1;
    read_some(0.02);
  }
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void PseudoTerminal::resize(int width) {
  winsize size{};
  size.ws_col = static_cast<unsigned short>(width);
  size.ws_row = height;
  screen_.set_width(width);
  ioctl(terminal_, TIOCSWINSZ, &size);
}

void PseudoTerminal::send_signal(int number) { kill(process_, number); }

}  // namespace tunica::shell
