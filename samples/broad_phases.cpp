// The same pairs by every search, and how many tests each takes: a table, and a picture of how the searches cut space.

#include <tweenfall/physics/pair_search.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

using namespace tweenfall;

namespace {

struct Named {
  const char* name;
  PairSearch search;
};
constexpr std::array<Named, 8> searches{{{"all-pairs", PairSearch::all_pairs},
                                         {"sweep", PairSearch::sweep},
                                         {"grid", PairSearch::grid},
                                         {"quadtree", PairSearch::quadtree},
                                         {"octree", PairSearch::octree},
                                         {"kd-tree", PairSearch::kd_tree},
                                         {"bvh", PairSearch::bvh},
                                         {"tree", PairSearch::tree}}};

/// A flat cloud that is dense to the left and thin to the right, so that trees have something to find.
std::vector<Bounds> cloud(int count) {
  std::vector<Bounds> boxes;
  boxes.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    // Multiples of the golden ratio and of the square root of two spread evenly.
    const double across = std::fmod(i * 0.6180339887498949, 1), up = std::fmod(i * 0.4142135623730951, 1);
    const double side = 0.06 + 0.18 * std::fmod(i * 0.7320508075688772, 1);
    const Vec3 low(20 * across * across, 10 * up, 0.1 * (i % 5));
    boxes.push_back({low, low + Vec3(side, side, side)});
  }
  return boxes;
}

constexpr double scale = 22, width = 22 * scale, height = 12 * scale;

void draw(std::ofstream& svg, const Named& named, const PairsFound& found, const std::vector<Bounds>& boxes,
          double left, double top) {
  const auto rectangle = [&](const Bounds& box, const char* style) {
    svg << "<rect x=\"" << left + scale * (1 + box.low.x()) << "\" y=\"" << top + scale * (11 - box.high.y())
        << "\" width=\"" << scale * (box.high.x() - box.low.x()) << "\" height=\""
        << scale * (box.high.y() - box.low.y()) << "\" " << style << "/>\n";
  };
  std::vector<bool> meets(boxes.size());
  for (const auto& [a, b] : found.pairs) meets[a] = meets[b] = true;
  for (const Bounds& cell : found.cells) rectangle(cell, "fill=\"none\" stroke=\"#b8c4d0\" stroke-width=\".6\"");
  for (std::size_t i = 0; i < boxes.size(); ++i)
    rectangle(boxes[i], meets[i] ? "fill=\"#e07a5f\"" : "fill=\"#81b29a\"");
  svg << "<text x=\"" << left + scale << "\" y=\"" << top + 0.8 * scale << "\">" << named.name << ": " << found.tests
      << " tests, " << found.pairs.size() << " pairs</text>\n";
}

}  // namespace

int main() {
  std::ofstream svg("broad_phases.svg");
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << 2 * width << "\" height=\"" << 4 * height
      << "\" font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  const std::vector<Bounds> drawn = cloud(300), many = cloud(3000);
  const PairsFound all = find_pairs(PairSearch::all_pairs, many);
  bool same = true;
  std::printf("3000 boxes      tests   pairs\n");
  for (std::size_t i = 0; i < searches.size(); ++i) {
    const PairsFound found = find_pairs(searches[i].search, many);
    std::printf("%-10s %10zu %7zu\n", searches[i].name, found.tests, found.pairs.size());
    same = same && found.pairs == all.pairs;
    const std::size_t column = i % 2, row = i / 2;
    draw(svg, searches[i], find_pairs(searches[i].search, drawn), drawn, width * static_cast<double>(column),
         height * static_cast<double>(row));
  }
  svg << "</svg>\n";
  return same && svg.good() ? 0 : 1;
}
