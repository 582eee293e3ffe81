// SPDX-License-Identifier: MIT
#include "sweep/range.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"

namespace tunica::sweep {

namespace {

constexpr int most_steps = 1'000'000;

std::vector<std::string> split(const std::string& text, char mark) {
  std::vector<std::string> parts;
  size_t from = 0;
  for (size_t at; (at = text.find(mark, from)) != std::string::npos; from = at + 1)
    parts.push_back(text.substr(from, at - from));
  parts.push_back(text.substr(from));
  return parts;
}

std::optional<double> read_number(const std::string& text) {
  double value = 0;
  const char* start = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(start, text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

double number_of(const Parameter& p, const std::string& text) {
  const auto value = read_number(text);
  if (!value) fail("parameter '{}': expected a number, a list 3,4,5 or a range 3..5, got '{}'", p.name, text);
  if (p.min && *value < *p.min) fail("parameter '{}': expected at least {}, got {}", p.name, *p.min, text);
  if (p.max && *value > *p.max) fail("parameter '{}': expected at most {}, got {}", p.name, *p.max, text);
  return *value;
}

/// A value of a list, or a fixed one, checked; numbers in their shortest form.
std::string value_of(const Parameter& p, const std::string& text) {
  if (p.type == Parameter::Type::number) return shortest(number_of(p, text));
  if (p.type == Parameter::Type::boolean && text != "true" && text != "false")
    fail("parameter '{}': expected true or false, got '{}'", p.name, text);
  return text;
}

/// What stands behind a range: steps, log, whole.
void read_options(Range& range, const std::vector<std::string>& parts) {
  for (size_t i = 1; i < parts.size(); ++i) {
    if (parts[i] == "log") {
      range.log = true;
    } else if (parts[i] == "whole") {
      range.whole = true;
    } else {
      const auto steps = read_number(parts[i]);
      if (!steps || *steps != std::floor(*steps) || *steps < 2 || *steps > most_steps)
        fail("parameter '{}': expected a number of steps from 2 on, log or whole behind the range, got '{}'{}",
             range.name, parts[i], did_you_mean(parts[i], {"log", "whole"}));
      range.steps = static_cast<int>(*steps);
    }
  }
}

Range read_interval(const Parameter& p, const std::string& text) {
  Range range{.name = p.name, .kind = Range::Kind::interval};
  const auto parts = split(text, ':');
  const size_t dots = parts[0].find("..");
  range.low = number_of(p, parts[0].substr(0, dots));
  range.high = number_of(p, parts[0].substr(dots + 2));
  if (range.low > range.high)
    fail("parameter '{}': the range {}..{} is reversed; write {}={}..{}", p.name, shortest(range.low),
         shortest(range.high), p.name, shortest(range.high), shortest(range.low));
  if (range.low == range.high)
    fail("parameter '{}': the range {} holds one value; write {}={}", p.name, parts[0], p.name, shortest(range.low));
  read_options(range, parts);
  if (range.log && range.low <= 0)
    fail("parameter '{}': a logarithmic range begins above 0, got {}", p.name, shortest(range.low));
  if (!std::isfinite(range.high - range.low))
    fail("parameter '{}': the range {} is wider than a number can be (1.8e308)", p.name, parts[0]);
  if (range.log && !std::isfinite(range.high / range.low))
    fail("parameter '{}': the logarithmic range {} spans more than 308 decades; begin it at {} or above", p.name,
         parts[0], shortest(range.high / 1e308));
  if (range.whole && (range.low != std::floor(range.low) || range.high != std::floor(range.high)))
    fail("parameter '{}': a range of whole numbers has whole ends, got {}", p.name, parts[0]);
  return range;
}

}  // namespace

std::string shortest(double value) { return fmt::format("{}", value == 0 ? 0.0 : value); }

std::string Range::at(double place) const {
  if (kind == Kind::fixed) return values[0];
  if (kind == Kind::list)
    return values[std::min(values.size() - 1, static_cast<size_t>(place * static_cast<double>(values.size())))];
  place = std::clamp(place, 0.0, 1.0);
  double value = 0;
  if (whole && !log)  // each whole number has an equal share of the places
    value = std::min(high, low + std::floor(place * (high - low + 1)));
  else if (log)
    value = low * std::pow(high / low, place);
  else
    value = low + place * (high - low);
  if (whole) value = std::round(value);
  return shortest(std::clamp(value, low, high));
}

double Range::place_of(double value) const {
  value = std::clamp(value, low, high);
  if (whole && !log) return (value - low + 0.5) / (high - low + 1);
  return log ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

std::vector<std::string> Range::grid() const {
  if (kind != Kind::interval) return values;
  int count = steps;
  if (count == 0 && whole && !log && high - low < most_steps) count = static_cast<int>(high - low) + 1;
  if (count == 0)
    fail("parameter '{}': a grid needs the number of steps; write {}={}..{}:9", name, name, shortest(low),
         shortest(high));
  std::vector<std::string> list;
  for (int i = 0; i < count; ++i) {
    const double place = static_cast<double>(i) / (count - 1);
    double value = log ? low * std::pow(high / low, place) : low + place * (high - low);
    if (i == count - 1) value = high;
    if (whole) value = std::round(value);
    const std::string text = shortest(value);
    if (list.empty() || list.back() != text) list.push_back(text);
  }
  return list;
}

std::string Range::text() const {
  if (kind == Kind::interval)
    return fmt::format("{}..{}{}{}{}", shortest(low), shortest(high), steps ? fmt::format(":{}", steps) : "",
                       log ? ":log" : "", whole ? ":whole" : "");
  return fmt::format("{}", fmt::join(values, ","));
}

Range read_range(const Parameter& p, const std::string& text) {
  const bool quoted = text.size() >= 2 && text.front() == '\'' && text.back() == '\'';
  if (quoted) return {.name = p.name, .values = {value_of(p, text.substr(1, text.size() - 2))}};
  if (p.type == Parameter::Type::number && text.find("..") != std::string::npos) return read_interval(p, text);
  Range range{.name = p.name};
  for (const auto& part : split(text, ',')) {
    const std::string value = value_of(p, part);
    if (std::find(range.values.begin(), range.values.end(), value) != range.values.end())
      fail("parameter '{}': {} is in the list twice", p.name, value);
    range.values.push_back(value);
  }
  if (range.values.size() > 1) range.kind = Range::Kind::list;
  return range;
}

std::vector<Range> read_ranges(const std::vector<Parameter>& parameters, const std::vector<std::string>& arguments) {
  std::vector<Range> ranges;
  for (const auto& argument : arguments) {
    const size_t equals = argument.find('=');
    if (equals == std::string::npos || equals == 0)
      fail("expected name=value or name=low..high for a parameter, got '{}'", argument);
    const std::string name = argument.substr(0, equals);
    std::vector<std::string> names;
    const Parameter* found = nullptr;
    for (const auto& p : parameters) {
      names.push_back(p.name);
      if (p.name == name) found = &p;
    }
    if (!found)
      fail("the model has no parameter '{}'{}; it has: {}", name, did_you_mean(name, names), fmt::join(names, ", "));
    for (const auto& range : ranges)
      if (range.name == name) fail("parameter '{}' is given twice", name);
    ranges.push_back(read_range(*found, argument.substr(equals + 1)));
  }
  return ranges;
}

}  // namespace tunica::sweep
