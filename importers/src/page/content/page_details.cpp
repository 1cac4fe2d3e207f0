#include "page/content/page_details.h"

#include "page/content/page_frames.h"
#include "recording/base64.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>

namespace tweenfall::page {

namespace {

using Frames = std::vector<std::size_t>;

/// A word for each frame, as runs: [[first frame, word], ...].
template <class WordOf>
std::string runs(std::size_t count, const WordOf& word_of) {
  std::string out = "[", before;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string word = word_of(i);
    if (i > 0 && word == before) continue;
    out += (i > 0 ? ",[" : "[") + std::to_string(i) + "," + word + "]";
    before = word;
  }
  return out + "]";
}

/// The details of one node, frame by frame; null where it had no body.
using Course = std::vector<const NodeDetail*>;

std::string node_json(NodeId node, const Course& course) {
  const auto at = [&](std::size_t i) { return course[i]; };
  std::string out = "{\"node\":" + std::to_string(node) + ",\"island\":";
  out += runs(course.size(), [&](std::size_t i) {
    return !at(i) || at(i)->island == no_node ? std::string("-1") : std::to_string(at(i)->island);
  });
  out += ",\"asleep\":";
  out += runs(course.size(), [&](std::size_t i) { return std::string(at(i) && at(i)->asleep ? "1" : "0"); });
  std::vector<float> boxes;
  boxes.reserve(6 * course.size());
  for (const NodeDetail* const detail : course)
    for (int i = 0; i < 6; ++i)
      boxes.push_back(!detail ? std::numeric_limits<float>::infinity()
                              : single(i < 3 ? detail->box.low[i] : detail->box.high[i - 3]));
  bool moves = false;
  for (std::size_t i = 6; i < boxes.size() && !moves; ++i) moves = boxes[i] != boxes[i - 6];
  if (!moves && boxes.size() > 6) boxes.resize(6);
  return out + ",\"boxes\":\"" + recordings::base64(std::span<const float>(boxes)) + "\"}";
}

void append_contacts(std::string& out, const Recording& recording, const Frames& frames) {
  std::vector<std::uint32_t> starts{0};
  std::vector<float> numbers;
  for (const std::size_t frame : frames) {
    for (const ContactDetail& contact : recording.details[frame].contacts) {
      for (int i = 0; i < 3; ++i) numbers.push_back(single(contact.point[i]));
      for (int i = 0; i < 3; ++i) numbers.push_back(single(contact.normal[i]));
      numbers.push_back(single(contact.impulse));
    }
    starts.push_back(static_cast<std::uint32_t>(numbers.size() / 7));
  }
  out += "\"starts\":\"" + recordings::base64(std::span<const std::uint32_t>(starts)) + "\",\"contacts\":\"" +
         recordings::base64(std::span<const float>(numbers)) + "\"";
}

}  // namespace

void append_details(std::string& out, const Recording& recording, const Frames& frames) {
  if (recording.details.size() != recording.times.size()) return;
  std::size_t points = 0, places = 0;
  for (const std::size_t frame : frames) {
    points += recording.details[frame].contacts.size();
    places += recording.details[frame].nodes.size();
  }
  if (points > most_page_contacts || places > 4 * most_page_places) return;
  std::map<NodeId, Course> courses;
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (const NodeDetail& detail : recording.details[frames[i]].nodes) {
      Course& course = courses[detail.node];
      course.resize(frames.size());
      course[i] = &detail;
    }
  out += ",\n\"details\":{";
  append_contacts(out, recording, frames);
  out += ",\"nodes\":[";
  bool first = true;
  for (const auto& [node, course] : courses) {
    out += (first ? "\n" : ",\n") + node_json(node, course);
    first = false;
  }
  out += "]}";
}

}  // namespace tweenfall::page
