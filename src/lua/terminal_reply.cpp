// SPDX-License-Identifier: MIT
#include "lua/terminal_reply.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>

#include "view/terminal.h"

namespace tunica::lua {
namespace {

using Clock = std::chrono::steady_clock;

std::string read_reply(int terminal) {
  std::string reply;
  const auto end = Clock::now() + std::chrono::seconds(1);
  while (reply.size() < 4096) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd ready{terminal, POLLIN, 0};
    if (left <= 0 || poll(&ready, 1, static_cast<int>(left)) <= 0) break;
    char c;
    if (read(terminal, &c, 1) != 1) break;
    reply += c;
    if (c == 'c' && split_reply(reply).complete) break;
  }
  return reply;
}

}  // namespace

std::string terminal_reply(const std::string& query) {
  const int terminal = open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (terminal < 0) return "";
  termios before{};
  std::string reply;
  if (tcgetpgrp(terminal) == getpgrp() && tcgetattr(terminal, &before) == 0) {
    termios raw = before;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // signals stay on: Ctrl-C works meanwhile
    raw.c_cc[VMIN] = 1;
    raw.c_cc[VTIME] = 0;
    // TCSANOW, not TCSAFLUSH: what the user has typed ahead is kept.
    tcsetattr(terminal, TCSANOW, &raw);
    if (write(terminal, query.data(), query.size()) == static_cast<ssize_t>(query.size())) reply = read_reply(terminal);
    tcsetattr(terminal, TCSANOW, &before);
  }
  close(terminal);
  return reply;
}

}  // namespace tunica::lua
