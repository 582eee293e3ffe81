// SPDX-License-Identifier: MIT
// Sessions at the prompt on a pseudo-terminal; what counts is what the screen shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "shell/prompt_session.h"

namespace tunica::shell {
namespace {

TEST_F(PromptTest, ShowsValuesAndKeepsTheLast) {
  start({"-q"});
  says("1 + 1", "\n2\n");
  says("ans * 10", "\n20\n");
  says("\"a\\nb\"", "\"a\\nb\"");
  says("{ 1, 2, x = { 3 } }", "{ 1, 2, x = { 3 } }");
  says("local a = {} for i = 1, 1e6 do a[i] = i end", "");
  says("a", "a list of 1000000 items");
  says("local only = 5", "");
  says("only + 1", "\n6\n");
  terminal_->type("only + 100;\r");
  EXPECT_TRUE(terminal_->stands_at(">"));
  EXPECT_FALSE(terminal_->shows("\n105\n", 0.2));
  says("ans", "105");
}

TEST_F(PromptTest, ContinuesOverSeveralLines) {
  start({"-q"});
  terminal_->type("for i = 1, 2 do\r");
  EXPECT_TRUE(terminal_->stands_at(">>"));
  terminal_->type("print('i', i)\r");
  EXPECT_TRUE(terminal_->stands_at(">>"));
  says("end", "i       2");
  says("function f(x)\r  return x * 2\rend", "");
  says("f(21)", "\n42\n");
  // The input was one entry, which comes back whole.
  terminal_->type("\x1b[A\x1b[A");
  EXPECT_TRUE(terminal_->shows("return x * 2"));
}

TEST_F(PromptTest, TakesPastedBlocksAndTranscripts) {
  start({"-q"});
  terminal_->type("\x1b[200~local n = 3\nfor i = 1, n do\n  m = i * 7\nend\x1b[201~");
  terminal_->watch(0.3);
  says("", "");
  says("m", "\n21\n");
  terminal_->type("\x1b[200~> k = 4\n> k * 2\n8\n\x1b[201~");
  terminal_->watch(0.3);
  terminal_->type("\r");
  EXPECT_TRUE(terminal_->stands_at(">"));
  says("k", "4");
}

TEST_F(PromptTest, RemembersBetweenProcesses) {
  start({"-q"});
  says("first_of_all = 1", "");
  PseudoTerminal other({TUNICA_PROGRAM, "-q"}, environment());
  EXPECT_TRUE(other.stands_at(">", 60));
  other.type("from_the_other = 2\r");
  EXPECT_TRUE(other.shows("\n>"));
  EXPECT_TRUE(other.stands_at(">"));
  says("if true then\rlast_of_all = 3\rend", "");
  says(" hidden = 4", "");
  other.type("\x04");
  EXPECT_EQ(other.exit_code(), 0);
  terminal_->type("\x04");
  EXPECT_EQ(terminal_->exit_code(), 0);
  const std::string kept = file("state/tunica/history");
  for (const char* line : {"first_of_all", "from_the_other", "last_of_all"})
    EXPECT_NE(kept.find(line), std::string::npos) << line << "\n" << kept;
  EXPECT_EQ(kept.find("hidden"), std::string::npos);
  EXPECT_EQ(fs::status(folder_ / "state/tunica/history").permissions() & fs::perms::others_read, fs::perms::none);
  start({"-q", "--private"});
  says("secret = 1", "");
  terminal_->type("\x04");
  EXPECT_EQ(terminal_->exit_code(), 0);
  EXPECT_EQ(file("state/tunica/history"), kept);
  start({"-q"});
  terminal_->type("\x1b[A");
  EXPECT_TRUE(terminal_->shows("last_of_all = 3"));
  terminal_->type("\x03");
  terminal_->watch(0.1);
  terminal_->type(
      "\x12"
      "from_the");  // searched
  EXPECT_TRUE(terminal_->shows("from_the_other = 2"));
}

TEST_F(PromptTest, Completes) {
  start({"-q", "-i", "patterning/ring"});
  terminal_->type("tiss\t");
  EXPECT_TRUE(terminal_->shows("> tissue")) << terminal_->screen().text();
  terminal_->type(":count_p\t");
  EXPECT_TRUE(terminal_->shows("tissue:count_peaks")) << terminal_->screen().text();
  terminal_->type(" \"aux\t");
  EXPECT_TRUE(terminal_->shows("tissue:count_peaks \"auxin\"")) << terminal_->screen().text();
  says("", "");
  terminal_->type("tunica.sh\t");
  EXPECT_TRUE(terminal_->shows("> tunica.sheet")) << terminal_->screen().text();
  terminal_->type(" { \t\t");
  EXPECT_TRUE(terminal_->shows("max_area ")) << terminal_->screen().text();
  terminal_->type("\x15P.\t\t");
  EXPECT_TRUE(terminal_->shows("diffusion")) << terminal_->screen().text();
  terminal_->type("\x15model:sn\t");
  EXPECT_TRUE(terminal_->shows("> model:snapshot")) << terminal_->screen().text();
  terminal_->type("\x15io.open \"/proc/self/cmd\t");
  EXPECT_TRUE(terminal_->shows("/proc/self/cmdline")) << terminal_->screen().text();
  terminal_->type("\x15load \"patterning/si\b\bri\t");
  EXPECT_TRUE(terminal_->shows("load \"patterning/ring")) << terminal_->screen().text();
  terminal_->type("\x15nothing_like_this\t\t");
  terminal_->watch(0.2);
  says(
      "\x15"
      "1 + 2",
      "\n3\n");
}

TEST_F(PromptTest, CompletesWithoutDelayWhereThereIsMuch) {
  start({"-q"});
  says("tissue = tunica.grid { 400, 250 }", "");
  says("tissue:cell { auxin = 1, pin = 2 } c = tissue:cells()()", "");
  says("big = {} for i = 1, 1e5 do big['name' .. i] = i end", "");
  terminal_->type("c.a\t");
  terminal_->watch(0.5);
  terminal_->type("\x15");
  for (const std::string& word :
       {std::string("tissue:"), std::string("c.aux"), std::string("big.name7"), std::string("tissue:mean \"")}) {
    terminal_->type("\x15" + word);
    terminal_->watch(0.2);
    const auto start = Clock::now();
    const size_t before = terminal_->bytes().size();
    terminal_->type("\t\t");
    while (terminal_->bytes().size() == before && Clock::now() - start < std::chrono::seconds(5))
      terminal_->watch(0.001);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    std::printf("completion of %s: %.0f ms\n", word.c_str(), seconds * 1000);
    EXPECT_LT(seconds, 0.5) << word;  // 50 ms on a machine with nothing else to do
    terminal_->watch(0.3);
  }
}

TEST_F(PromptTest, ErrorsShowWhereAndWithWhat) {
  std::ofstream(folder_ / "broken.lua") << "local tunica = require \"tunica\"\n"
                                           "local function inner(weight)\n"
                                           "  local sum = weight + nothing_here\n"
                                           "  return sum\n"
                                           "end\n"
                                           "function outer() local got = inner(7) return got end\n";
  start({"-q"});
  says("dofile '" + (folder_ / "broken.lua").string() + "'", "");
  says("outer()", "^^^^^^^^^^^^");
  EXPECT_TRUE(terminal_->shows("3 |   local sum = weight + nothing_here"));
  EXPECT_TRUE(terminal_->shows("weight = 7"));
  EXPECT_TRUE(terminal_->shows("broken.lua:6 in 'outer'")) << terminal_->screen().text();
  says("x = = 3", "unexpected symbol near '='");
  says("undefined_thing", "variable 'undefined_thing' is not defined");
  says("error({})", "a value that is not text");
  says("tissue = tunica.ring { 10 } tissue:cell { auxin = 1 }", "");
  says("model = tunica.model { tissue = tissue, dt = .1 }", "");
  says("model:rate(function(c, d) if c.auxin == 1 then local id = c.id error 'bad cell' end d.auxin = 0 end)", "");
  says("run(1)", "the rate rule of cells");
  EXPECT_TRUE(terminal_->shows("bad cell"));
  EXPECT_TRUE(terminal_->shows("auxin 1")) << terminal_->screen().text();
}

TEST_F(PromptTest, StopsWhateverRuns) {
  start({"-q", "-i", "patterning/sheet"});
  std::vector<double> times;
  const auto stops = [&](const std::string& line, double before = 0.5) {
    times.push_back(time_to_stop(line, before));
    std::printf("stopped after %3.0f ms: %s\n", times.back() * 1000, line.c_str());
    EXPECT_LT(times.back(), 2) << line;  // 0.2 s on a machine with nothing else to do
    terminal_->type("1 + 1\r");          // one Ctrl-C in a row only
    EXPECT_TRUE(terminal_->shows("\n2\n"));
    EXPECT_TRUE(terminal_->stands_at(">"));
  };
  stops("while true do end");
  stops("while true do pcall(function() while true do end end) end");
  stops("local t = {} while true do t[#t % 100 + 1] = {} end");
  stops("run(1e6)", 1);
  EXPECT_GT(terminal_->screen().text().find("stopped at t = "), 0u);
  says("model.time > 0", "true");
  says("run { by = 1 }", "now at t =");
  stops("model:at(model.time, function() while true do end end) run { by = 1 }");
  says("model.time > 0", "true");
  says("ring = tunica.ring { 2000 } ring:cell { x = 1 }", "");
  says("other = tunica.model { tissue = ring, dt = 0.001 }", "");
  says("other:rate(function(c, d) if c.x ~= 2 then d.x = 0.1 end end)", "");
  stops("run(other, 1e6)", 1);
  stops("while true do local s = tunica.hexagons { 316, 316 } s:divide { above = 0.1 } end", 1);
  stops("while true do tissue:picture { '" + (folder_ / "a.png").string() + "', size = 2000 } end", 1);
  std::sort(times.begin(), times.end());
  std::printf("median %.0f ms\n", times[times.size() / 2] * 1000);
}

TEST_F(PromptTest, ASecondInterruptAsksToLeave) {
  start({"-q"});
  terminal_->type("half a line\x03");
  EXPECT_TRUE(terminal_->stands_at(">"));
  terminal_->type("\x03");
  EXPECT_TRUE(terminal_->shows("leave tunica?"));
  terminal_->type("n\r");
  EXPECT_TRUE(terminal_->stands_at(">"));
  says("1 + 1", "\n2\n");
  terminal_->type("\x03");
  EXPECT_TRUE(terminal_->stands_at(">"));
  terminal_->watch(0.2);
  terminal_->type("\x03");
  EXPECT_TRUE(terminal_->shows("leave tunica?"));
  terminal_->type("y\r");
  EXPECT_EQ(terminal_->exit_code(), 0);
  start({"-q"});
  terminal_->send_signal(SIGTERM);
  EXPECT_EQ(terminal_->exit_code(), 143);
}

TEST_F(PromptTest, WhatCannotBeStoppedIsSaid) {
  start({"-q"});
  terminal_->type("string.rep('a', 30000):find(('a*'):rep(30) .. 'b')\r");
  terminal_->watch(0.3);
  terminal_->type("\x03");
  terminal_->watch(0.4);
  terminal_->type("\x03");
  EXPECT_TRUE(terminal_->shows("still stopping")) << terminal_->screen().text();
  terminal_->type("\x03");
  EXPECT_EQ(terminal_->exit_code(), 130);
}

TEST_F(PromptTest, WhatDoesNotReturnIsLeftAndTheStateIsKept) {
  const std::string endless = "string.rep('a', 30000):find(('a*'):rep(30) .. 'b')";
  start({"-q", "-i", "patterning/sheet", "cells=60"});
  says("run(2)", "now at t = 2");
  says("x = 17", "");
  const auto begin = Clock::now();
  terminal_->type(endless + "\r");
  terminal_->watch(0.3);
  terminal_->type("\x03");
  EXPECT_TRUE(terminal_->shows("The state at t = 2 is kept")) << terminal_->screen().text();
  EXPECT_EQ(terminal_->exit_code(), 130);
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - begin).count(), 8);
  std::string kept;
  for (const auto& entry : fs::directory_iterator(folder_ / "state/tunica"))
    if (entry.path().filename().string().starts_with("rescued")) kept = entry.path().string();
  start({"-q"}, {}, 200);
  says("restore '" + kept + "'", "sheet at t = 2");
  says("x", "\n17\n");
  says("run(4)", "now at t = 4: 200 steps");
  // What was typed is kept of a model that has no file; three times Ctrl-C does not wait.
  start({"-q"}, {}, 200);
  says("here = 1", "");
  terminal_->type(endless + "\r");
  terminal_->watch(0.3);
  for (int i = 0; i < 3; ++i) {
    terminal_->type("\x03");
    terminal_->watch(0.2);
  }
  EXPECT_TRUE(terminal_->shows("What was typed before is kept in")) << terminal_->screen().text();
  EXPECT_EQ(terminal_->exit_code(2), 130);
}

TEST_F(PromptTest, RunsLooksAndPlots) {
  start({"-q", "-i", "patterning/sheet", "cells=60"});
  says("run(model, {until = 2})", "now at t = 2: 200 steps");
  says("step(3)", "3 steps");
  says("column \"auxin\"", "cells, ");
  says("plot \"peaks\"", "peaks over time");
  says("tissue", "auxin ");
  says("?run", "Runs the model at hand");
  says("reload()", "has not changed");
  says("undo(2)", "");
  says("P", "diffusion");
  terminal_->type("show()\r");
  EXPECT_TRUE(terminal_->stands_at(">", 60)) << terminal_->screen().text();
  EXPECT_TRUE(terminal_->shows("t = "));  // of blocks: letters would be blobs
  EXPECT_TRUE(terminal_->shows("auxin"));
  EXPECT_EQ(terminal_->screen().text().find("error"), std::string::npos) << terminal_->screen().text();
}

TEST_F(PromptTest, RulesTypedHereFollowVariables) {
  start({"-q"});
  says("tissue = tunica.ring { 10 } tissue:cell { x = 0 }", "");
  says("model = tunica.model { tissue = tissue, dt = 1 }", "");
  says("local rate = 1", "");
  says("model:rate(function(c, d) d.x = rate end)", "");
  says("run(2)", "now at t = 2");
  says("tissue:mean 'x'", "\n2\n");
  says("rate = 10", "");
  says("run(3)", "now at t = 3");
  says("tissue:mean 'x'", "\n12\n");
  says("undo()", "");
  says("tissue:mean 'x'", "\n2\n");
}

TEST_F(PromptTest, StartsAtOnce) {
  double least = 1e9;
  for (int i = 0; i < 5; ++i) {
    const auto begin = Clock::now();
    start();
    least = std::min(least, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  std::printf("from start to prompt: %.0f ms\n", least * 1000);
  EXPECT_LT(least, 0.6);  // 60 ms on a machine with nothing else to do
}

TEST_F(PromptTest, HasManners) {
  fs::create_directories(folder_ / "config/tunica");
  std::ofstream(folder_ / "config/tunica/init.lua")
      << "function twice(x) return 2 * x end\nlocal here = 1\nerror 'late'\n";
  start({});
  EXPECT_TRUE(terminal_->shows("init.lua:3: late")) << terminal_->screen().text();
  says("twice(4)", "\n8\n");
  terminal_->type("quit\r");
  EXPECT_EQ(terminal_->exit_code(), 0);
  start({"-q", "--no-init"});
  says("twice", "not defined");
  EXPECT_FALSE(terminal_->screen().coloured());
  start({"-q"}, {{"NO_COLOR", ""}});
  says("nothing", "not defined");
  EXPECT_TRUE(terminal_->screen().coloured());
  start({"-q", "--color", "never"}, {{"NO_COLOR", ""}});
  says("nothing", "not defined");
  EXPECT_FALSE(terminal_->screen().coloured());
  start({"-q", "--no-init"}, {{"TERM", "dumb"}, {"NO_COLOR", ""}});
  says("1 + 1", "2");
  says("plot { 1, 2, 3 }", "*");
  EXPECT_EQ(terminal_->bytes().find('\033'), std::string::npos);
  start({"-q", "-i", "patterning/ring"}, {}, 40);
  says("model", "model ring");
  says("P", "=");
  says("run(1)", "now at");
  says("plot \"auxin\"", "auxin over time");
  for (std::string text = terminal_->screen().text(); !text.empty();) {
    const size_t end = text.find('\n');
    size_t columns = 0;
    for (const char c : text.substr(0, end)) columns += (c & 0xC0) != 0x80;
    EXPECT_LE(columns, 40u) << text.substr(0, end);
    text.erase(0, end + 1);
  }
}

}  // namespace
}  // namespace tunica::shell
