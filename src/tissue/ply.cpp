// SPDX-License-Identifier: MIT
#include "tissue/ply.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "base/error.h"
#include "tissue/mesh.h"

namespace tunica {

namespace {

/// The words of a text, line by line.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  /// The words of the next line that has any. Errors: the text is at its end.
  const std::vector<std::string_view>& next(const char* expected) {
    do {
      if (rest_.empty()) fail("line {}: the file ends where {} is expected", number_ + 1, expected);
      const size_t end = std::min(rest_.find('\n'), rest_.size());
      split(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
    } while (words_.empty());
    return words_;
  }
  size_t number() const { return number_; }
  size_t bytes_left() const { return rest_.size(); }

 private:
  void split(std::string_view line) {
    words_.clear();
    size_t at = 0;
    while (true) {
      at = line.find_first_not_of(" \t\r", at);
      if (at == std::string_view::npos) return;
      const size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
      words_.push_back(line.substr(at, end - at));
      at = end;
    }
  }
  std::string_view rest_;
  std::vector<std::string_view> words_;
  size_t number_ = 0;
};

/// What a word from the file looks like in a message: short, and nothing that a terminal would act on.
std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return text;
}

double number_in(std::string_view word, const Lines& lines) {
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value) || std::abs(value) > 1e30)
    fail("line {}: '{}' is not a number", lines.number(), shown(word));
  return value;
}

int64_t integer_in(std::string_view word, const Lines& lines) {
  int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || std::abs(value) > (int64_t{1} << 40))
    fail("line {}: '{}' is not a whole number", lines.number(), shown(word));
  return value;
}

struct Property {
  std::string name;
  bool list = false;
};

struct Element {
  std::string name;
  size_t count = 0;
  std::vector<Property> properties;

  /// Place of a plain property among the words of a line, if no list comes before it. Errors: there is none.
  size_t place_of(std::string_view wanted, const Lines& lines) const {
    for (size_t i = 0; i < properties.size() && !properties[i].list; ++i)
      if (properties[i].name == wanted) return i;
    fail("line {}: the header gives a {} no property '{}'", lines.number(), name, wanted);
  }
};

std::vector<Element> read_header(Lines& lines) {
  if (const auto& words = lines.next("'ply'"); words.size() != 1 || words[0] != "ply")
    fail("line {}: not a PLY file: it starts with '{}' and not with 'ply'", lines.number(), shown(words[0]));
  std::vector<Element> elements;
  bool ascii = false;
  while (true) {
    const auto& words = lines.next("'end_header'");
    if (words[0] == "end_header") break;
    if (words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "format") {
      if (words.size() < 2 || words[1] != "ascii") fail("line {}: only ascii PLY files are read", lines.number());
      ascii = true;
    } else if (words[0] == "element" && words.size() == 3 && elements.size() < 100) {
      const int64_t count = integer_in(words[2], lines);
      // A line of data has at least a digit and its end: a greater count than that is a lie, and must not be believed.
      if (count < 0 || static_cast<size_t>(count) > lines.bytes_left() / 2 + 1)
        fail("line {}: {} elements are announced, more than the file has room for", lines.number(), count);
      elements.push_back({std::string(words[1]), static_cast<size_t>(count), {}});
    } else if (words[0] == "property" && words.size() >= 3 && !elements.empty()) {
      // A list is 'property list COUNT ITEM NAME', and names may have blanks.
      const bool list = words[1] == "list";
      if (list && words.size() < 5) fail("line {}: a list property needs two types and a name", lines.number());
      elements.back().properties.push_back({std::string(words[list ? 4 : 2]), list});
    } else {
      fail("line {}: '{}' is not understood in the header", lines.number(), shown(words[0]));
    }
  }
  if (!ascii) fail("line {}: the header names no format", lines.number());
  return elements;
}

/// Passes over the lines of an element that is not needed.
void skip(Lines& lines, const Element& element) {
  for (size_t i = 0; i < element.count; ++i) lines.next("more data");
}

void require_words(const std::vector<std::string_view>& words, size_t least, const Lines& lines) {
  if (words.size() < least)
    fail("line {}: {} values where at least {} are expected", lines.number(), words.size(), least);
}

void read_vertices(Lines& lines, const Element& element, LabelledMesh& mesh) {
  const size_t x = element.place_of("x", lines), y = element.place_of("y", lines), z = element.place_of("z", lines);
  for (size_t i = 0; i < element.count; ++i) {
    const auto& words = lines.next("a vertex");
    require_words(words, std::max({x, y, z}) + 1, lines);
    mesh.points.emplace_back(number_in(words[x], lines), number_in(words[y], lines), number_in(words[z], lines));
  }
}

void read_faces(Lines& lines, const Element& element, LabelledMesh& mesh) {
  if (element.properties.size() < 2 || !element.properties[0].list || element.properties[1].name != "label")
    fail("line {}: a face must have a list of vertices and then a label (a cell mesh of MorphoGraphX)", lines.number());
  for (size_t i = 0; i < element.count; ++i) {
    const auto& words = lines.next("a face");
    if (integer_in(words[0], lines) != 3)
      fail("line {}: a face of {} vertices; triangles are expected", lines.number(), shown(words[0]));
    require_words(words, 5, lines);
    std::array<Index, 3> corners;
    for (size_t k = 0; k < 3; ++k) {
      const int64_t vertex = integer_in(words[k + 1], lines);
      if (vertex < 0 || static_cast<size_t>(vertex) >= mesh.points.size())
        fail("line {}: vertex {} does not exist; there are {}", lines.number(), vertex, mesh.points.size());
      corners[k] = static_cast<Index>(vertex);
    }
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
      fail("line {}: a triangle with the same vertex twice", lines.number());
    mesh.triangles.push_back({corners, integer_in(words[4], lines)});
  }
}

}  // namespace

Tissue read_ply(std::string_view text, PlyWalls walls, uint64_t seed) {
  Lines lines(text);
  LabelledMesh mesh;
  bool vertices = false, faces = false;
  for (const Element& element : read_header(lines)) {
    if (element.name == "vertex" && !vertices) {
      read_vertices(lines, element, mesh);
      vertices = true;
    } else if (element.name == "face" && vertices && !faces) {
      read_faces(lines, element, mesh);
      faces = true;
    } else {
      skip(lines, element);
    }
  }
  if (!faces) fail("line {}: there are no faces after vertices, so this is no cell mesh", lines.number());
  return cells_of(mesh, walls == PlyWalls::traced, seed);
}

CellGraph read_cell_graph(std::string_view text) {
  Lines lines(text);
  CellGraph graph;
  std::set<int64_t> known;
  for (const Element& element : read_header(lines)) {
    if (element.name == "vertex") {
      const size_t label = element.place_of("label", lines), area = element.place_of("Geometry/Area", lines);
      const size_t x = element.place_of("x", lines), y = element.place_of("y", lines), z = element.place_of("z", lines);
      for (size_t i = 0; i < element.count; ++i) {
        const auto& words = lines.next("a cell");
        require_words(words, std::max({label, area, x, y, z}) + 1, lines);
        graph.labels.push_back(integer_in(words[label], lines));
        graph.centres.emplace_back(number_in(words[x], lines), number_in(words[y], lines), number_in(words[z], lines));
        graph.areas.push_back(number_in(words[area], lines));
        if (!known.insert(graph.labels.back()).second)
          fail("line {}: cell {} comes twice", lines.number(), graph.labels.back());
      }
    } else if (element.name == "edge") {
      const size_t source = element.place_of("source", lines), target = element.place_of("target", lines);
      for (size_t i = 0; i < element.count; ++i) {
        const auto& words = lines.next("an edge");
        require_words(words, std::max(source, target) + 1, lines);
        const int64_t a = integer_in(words[source], lines), b = integer_in(words[target], lines);
        if (!known.count(a) || !known.count(b) || a == b) fail("line {}: no two cells {} and {}", lines.number(), a, b);
        graph.edges.emplace_back(std::min(a, b), std::max(a, b));
      }
    } else {
      skip(lines, element);
    }
  }
  std::sort(graph.edges.begin(), graph.edges.end());
  graph.edges.erase(std::unique(graph.edges.begin(), graph.edges.end()), graph.edges.end());
  return graph;
}

}  // namespace tunica
