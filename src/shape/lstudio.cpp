// SPDX-License-Identifier: MIT
#include "shape/lstudio.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"

namespace tunica {

namespace {

constexpr int most_points = 10000, most_curves = 10000;

/// What the formats have besides points, in small letters; the value of those marked * counts.
const std::vector<std::string> known_keys = {"name",
                                             "samples",
                                             "flip",
                                             "background",
                                             "backgroundxy",
                                             "points",
                                             "range",
                                             "type",
                                             "contact",
                                             "end",
                                             "up",
                                             "heading",
                                             "size",
                                             "dimension",
                                             "version",
                                             "start",
                                             "color",
                                             "startlabel",
                                             "endlabel",
                                             "items",
                                             "timelinefunceditfilestart",
                                             "timelinefunceditfileend"};

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && is_blank(s.front())) s.remove_prefix(1);
  while (!s.empty() && is_blank(s.back())) s.remove_suffix(1);
  return s;
}

std::vector<std::string_view> words_of(std::string_view s) {
  std::vector<std::string_view> words;
  for (s = trimmed(s); !s.empty(); s = trimmed(s)) {
    const size_t end = std::min(s.find_first_of(" \t"), s.size());
    words.push_back(s.substr(0, end));
    s.remove_prefix(end);
  }
  return words;
}

std::string lower(std::string_view s) {
  std::string text(s);
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// What is quoted of a file in a message: short, and without what a terminal would act on.
std::string quoted(std::string_view s) {
  std::string text(s.substr(0, 40));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return text + (s.size() > 40 ? "..." : "");
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& file) : rest_(text), file_(file) {}
  std::vector<DrawnCurve> read();

 private:
  struct Body {
    DrawnCurve curve;
    int line = 0, announced = -1, in_all = -1, given = 0, columns = 0;
    bool closes = false;
    std::vector<std::string> keys;
  };
  template <class... Args>
  [[noreturn]] void wrong(fmt::format_string<Args...> format, Args&&... args) const {
    fail("{}:{}: {}", file_, line_, fmt::format(format, std::forward<Args>(args)...));
  }
  bool next_line(std::string_view& line);
  double number(std::string_view word) const;
  int whole(std::string_view word, int least, int most, const char* what) const;
  bool header(const std::vector<std::string_view>& words);
  bool old_contour(const std::vector<std::string_view>& words);
  void key(std::string_view key, std::string_view value);
  void gallery_key(const std::string& key, std::string_view value);
  void point(const std::vector<std::string_view>& words);
  void type_of_ends(std::string_view value);
  void begin(bool is_function);
  void close();

  std::string_view rest_;
  const std::string& file_;
  int line_ = 0, items_ = -1;
  enum class Kind { unknown, function, contour } kind_ = Kind::unknown;
  bool open_ = false, timeline_ = false;
  Body body_;
  double start_ = 0, end_ = 0;
  std::vector<DrawnCurve> curves_;
};

bool Reader::next_line(std::string_view& line) {
  if (rest_.empty()) return false;
  const size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  line = trimmed(rest_.substr(0, end));
  const bool both = end + 1 < rest_.size() && rest_[end] == '\r' && rest_[end + 1] == '\n';
  rest_.remove_prefix(std::min(end + (both ? 2 : 1), rest_.size()));
  ++line_;
  return true;
}

double Reader::number(std::string_view word) const {
  double value = 0;
  const char* from = word.data() + (word.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(from, word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    wrong("expected a number, came '{}'", quoted(word));
  return value;
}

int Reader::whole(std::string_view word, int least, int most, const char* what) const {
  const double value = number(word);
  if (value != std::floor(value) || value < least || value > most)
    wrong("{} must be a whole number from {} to {}, came '{}'", what, least, most, quoted(word));
  return static_cast<int>(value);
}

void Reader::begin(bool is_function) {
  if (open_) close();
  body_ = Body();
  body_.curve.is_function = is_function;
  body_.curve.ends = is_function ? Ends::clamped : Ends::open;
  body_.curve.samples = is_function ? 0 : 8;  // of contours before version 1.3
  body_.curve.start = start_;
  body_.curve.end = end_;
  body_.line = line_;
  open_ = true;
}

void Reader::close() {
  open_ = false;
  if (body_.announced < 0) wrong("the curve that starts in line {} says nowhere how many points it has", body_.line);
  if (body_.given < body_.announced)
    wrong("the curve that starts in line {} announces {} points and has {}", body_.line, body_.announced, body_.given);
  const int in_all = static_cast<int>(body_.curve.points.size());
  if (body_.in_all >= 0 && body_.in_all != in_all)
    wrong("the curve that starts in line {} announces {} points in all and has {}", body_.line, body_.in_all, in_all);
  if (body_.closes && body_.curve.points.front() != body_.curve.points.back())
    body_.curve.points.push_back(body_.curve.points.front());
  try {
    if (body_.curve.is_function)
      body_.curve.function();
    else
      body_.curve.contour();
  } catch (const Error& error) {
    fail("{}:{}: {}", file_, body_.line, error.what());
  }
  if (static_cast<int>(curves_.size()) == most_curves) wrong("more than {} curves in one file", most_curves);
  curves_.push_back(std::move(body_.curve));
}

/// "fver 1 1" and its like; true if the line was one.
bool Reader::header(const std::vector<std::string_view>& words) {
  const std::string_view word = words[0];
  const bool gallery = word == "funcgalleryver" || word == "contourgalleryver" || word == "timeEdit";
  if (!gallery && word != "fver" && word != "cver") return false;
  const bool of_functions = word == "fver" || word == "funcgalleryver" || word == "timeEdit";
  if (words.size() != 3) wrong("expected '{} major minor'", word);
  const int major = whole(words[1], 0, 1000, "the version"), minor = whole(words[2], 0, 1000, "the version");
  const int known = word == "cver" ? 4 : word == "timeEdit" ? 2 : 1;
  if (major != 1 || minor > known)
    wrong("version {}.{} of '{}' is not known; 1.0 to 1.{} are", major, minor, word, known);
  if (gallery && (open_ || !curves_.empty())) wrong("'{}' must come first in a file", word);
  if (kind_ != Kind::unknown && of_functions != (kind_ == Kind::function))
    wrong("a file holds functions or contours, not both");
  kind_ = of_functions ? Kind::function : Kind::contour;
  timeline_ = timeline_ || word == "timeEdit";
  if (!gallery) begin(of_functions);
  return true;
}

/// The first line of a contour of version 1.0: "n dimension open|closed".
bool Reader::old_contour(const std::vector<std::string_view>& words) {
  if (words.size() != 3 || (words[2] != "open" && words[2] != "closed")) return false;
  kind_ = Kind::contour;
  begin(false);
  body_.announced = whole(words[0], 1, most_points, "the number of points");
  body_.columns = 3;
  whole(words[1], 2, 4, "the dimension");
  type_of_ends(words[2]);
  return true;
}

void Reader::type_of_ends(std::string_view value) {
  if (value == "or" || value == "open" || value == "bspline")
    body_.curve.ends = Ends::open;
  else if (value == "cr" || value == "closed")
    body_.curve.ends = Ends::closed;
  else if (value == "oe" || value == "ce")
    body_.curve.ends = Ends::clamped;
  else
    wrong("the type of a contour is one of or, cr, oe, ce, open, closed, bspline; came '{}'", quoted(value));
  body_.closes = value == "ce";
}

void Reader::gallery_key(const std::string& key, std::string_view value) {
  if (key == "items")
    items_ = whole(value, 0, most_curves, "the number of curves");
  else if (key == "start")
    start_ = number(value);
  else if (key == "end")
    end_ = number(value);
  else if (key.starts_with("timeline") && open_)
    close();
}

void Reader::key(std::string_view given, std::string_view value) {
  const std::string key = lower(given);
  if (std::find(known_keys.begin(), known_keys.end(), key) == known_keys.end()) {
    const std::string hint = did_you_mean(key, known_keys);
    if (!hint.empty()) wrong("there is no key '{}'{}", quoted(given), hint);
    return;  // of a later version, perhaps
  }
  const bool between = timeline_ && (!open_ || key.starts_with("timeline"));
  if (between || (key == "items" && !open_)) return gallery_key(key, value);
  if (key == "version" && kind_ == Kind::unknown) kind_ = Kind::contour;
  if (kind_ == Kind::unknown && (key == "contact" || key == "type")) kind_ = Kind::contour;
  if (kind_ == Kind::unknown) kind_ = Kind::function;
  // Bodies without a header follow each other: a key that comes again starts the next.
  const bool again = std::find(body_.keys.begin(), body_.keys.end(), key) != body_.keys.end();
  if (!open_ || again) begin(kind_ == Kind::function);
  body_.keys.push_back(key);
  const auto words = words_of(value);
  if (key == "name") body_.curve.name = std::string(value.substr(0, 200));
  if (key == "type") type_of_ends(value);
  if (key == "samples" && words.size() == 1) body_.curve.samples = whole(words[0], 0, 1 << 30, "samples");
  if (key == "points") {
    if (words.empty() || words.size() > 2) wrong("expected 'points: n' or 'points: n m', came '{}'", quoted(value));
    if (body_.announced >= 0) wrong("the number of points is given twice");
    body_.announced = whole(words[0], 1, most_points, "the number of points");
    if (words.size() == 2) body_.in_all = whole(words[1], 1, 3 * most_points, "the sum of multiplicities");
  }
}

void Reader::point(const std::vector<std::string_view>& words) {
  if (!open_) wrong("numbers before any curve: '{}'; expected a file of L-Studio", quoted(words[0]));
  if (body_.announced < 0) wrong("points come after 'points: n'");
  if (body_.given == body_.announced) wrong("more than the {} points announced", body_.announced);
  const bool flat = body_.curve.is_function;
  const size_t least = flat ? 2 : 2, most = flat ? 3 : body_.columns == 3 ? 3 : 4;
  if (words.size() < least || words.size() > most)
    wrong("expected '{}', came {} numbers", flat ? "x y multiplicity" : "x y z multiplicity", words.size());
  const Vec2 p(number(words[0]), number(words[1]));
  if (!flat && words.size() > 2 && number(words[2]) != 0)
    wrong("the contour is not planar: z is {}; expected 0", quoted(words[2]));
  const int times = words.size() == (flat ? 3u : 4u) ? whole(words.back(), 1, 3, "the multiplicity of a point") : 1;
  body_.curve.points.insert(body_.curve.points.end(), static_cast<size_t>(times), p);
  ++body_.given;
}

std::vector<DrawnCurve> Reader::read() {
  for (std::string_view line; next_line(line);) {
    if (line.empty()) continue;
    const auto words = words_of(line);
    if (header(words) || (kind_ == Kind::unknown && old_contour(words))) continue;
    const size_t colon = line.find(':');
    const bool letter = (line[0] >= 'a' && line[0] <= 'z') || (line[0] >= 'A' && line[0] <= 'Z');
    if (letter && colon != std::string_view::npos)
      key(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
    else if (letter)
      wrong("expected 'key: value' or numbers, came '{}'", quoted(line));
    else
      point(words);
  }
  if (open_) close();
  if (items_ >= 0 && items_ != static_cast<int>(curves_.size()))
    wrong("the gallery announces {} curves and has {}", items_, curves_.size());
  if (curves_.empty())
    fail("{}: no curve in it; expected a file of L-Studio (.func, .con, .fset, .tset, .cset)", file_);
  return std::move(curves_);
}

// === Writing

/// The cubic that is the same curve; see write_contour.
std::vector<Vec2> as_cubic(const std::vector<Vec2>& p, int degree, Ends ends) {
  if (degree == 3) return p;
  if (ends == Ends::clamped && degree == 2 && p.size() == 3)
    return {p[0], (p[0] + 2 * p[1]) / 3, (2 * p[1] + p[2]) / 3, p[2]};
  if (ends == Ends::clamped && degree == 1 && p.size() == 2)
    return {p[0], (2 * p[0] + p[1]) / 3, (p[0] + 2 * p[1]) / 3, p[1]};
  if (degree != 1 || ends == Ends::closed)
    fail("a file of L-Studio holds cubic curves; this one has {} points and degree {}", p.size(), degree);
  std::vector<Vec2> points;  // thrice the same point is a corner
  for (size_t i = 0; i < p.size(); ++i) points.insert(points.end(), i == 0 || i + 1 == p.size() ? 1 : 3, p[i]);
  return points;
}

struct Repeated {
  Vec2 point;
  int times;
};

std::vector<Repeated> counted(const std::vector<Vec2>& points) {
  std::vector<Repeated> list;
  for (const Vec2& p : points) {
    if (!list.empty() && list.back().point == p && list.back().times < 3)
      ++list.back().times;
    else
      list.push_back({p, 1});
  }
  return list;
}

/// A name takes one line.
std::string one_line(const std::string& name) {
  std::string text = name.substr(0, 200);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32) c = ' ';
  return text;
}

}  // namespace

std::vector<DrawnCurve> read_lstudio(std::string_view text, const std::string& file) {
  return Reader(text, file).read();
}

std::string write_contour(const std::string& name, std::vector<Vec2> points, int degree, Ends ends) {
  // Straight pieces start and end in their outer points, whatever the ends.
  points = as_cubic(points, degree, ends);
  if (degree == 1) ends = Ends::clamped;
  const auto list = counted(points);
  const char* type = ends == Ends::open ? "or" : ends == Ends::closed ? "cr" : "oe";
  std::string text = fmt::format("cver 1 3\nname: {}\npoints: {} {}\ntype: {}\nsamples: 8\n", one_line(name),
                                 list.size(), points.size(), type);
  for (const auto& [p, times] : list) text += fmt::format("{} {} 0 {}\n", p.x(), p.y(), times);
  return text;
}

std::string write_function(const std::string& name, const Curve& curve) {
  std::vector<Vec2> points = curve.points();
  if (curve.is_constant()) points.push_back(points[0] + Vec2(1, 0));
  points = as_cubic(points, std::min(curve.degree(), static_cast<int>(points.size()) - 1), Ends::clamped);
  const auto list = counted(points);
  std::string text =
      fmt::format("fver 1 1\nname: {}\nsamples: 100\nflip: off\npoints: {}\n", one_line(name), list.size());
  for (const auto& [p, times] : list) text += fmt::format("{} {} {}\n", p.x(), p.y(), times);
  return text;
}

}  // namespace tunica
