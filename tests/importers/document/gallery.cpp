#include <tweenfall/curves/ease.h>

#include "importers/document/document_files.h"

#include <set>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

using Json = nlohmann::json;

void add_texts(const Json& value, std::set<std::string>& texts) {
  if (value.is_string()) texts.insert(value.get<std::string>());
  for (const auto& [name, item] : value.items()) {
    if (value.is_object()) texts.insert(name);
    if (value.is_structured()) add_texts(item, texts);
  }
}

/// The words of all texts that say an ease, without numbers and, for families, without their direction.
std::string ease_word(const std::string& text) {
  std::string word = text.substr(0, text.find('('));
  if (word.starts_with("ease")) return word;
  for (const std::string ending : {"-in-out", "-out", "-in"})
    if (word.ends_with(ending)) return word.substr(0, word.size() - ending.size());
  return word;
}

}  // namespace

TEST_CASE("the gallery has a curve of every kind that the schema knows") {
  const std::filesystem::path file = std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents/curves.json";
  const Document document = Document::read(file);
  CHECK(document.stage().clips.at(0).tracks.size() > 40);

  std::set<std::string> said, eases;
  add_texts(Json::parse(text_of(file), nullptr, true, true), said);
  for (const std::string& text : said) eases.insert(ease_word(text));
  for (const std::string& form : Ease::names()) {
    CAPTURE(form);
    CHECK(eases.count(ease_word(form)) == 1);
  }

  const Json definitions = Json::parse(document_schema()).at("definitions");
  const auto check_words = [&](const Json& words) {
    REQUIRE(words.size() > 2);
    for (const Json& word : words) {
      CAPTURE(word.get<std::string>());
      CHECK(said.count(word.get<std::string>()) == 1);
    }
  };
  check_words(definitions.at("tangent-number").at("anyOf").at(0).at("enum"));
  check_words(definitions.at("outside-number").at("anyOf").at(0).at("enum"));
  Json fields = definitions.at("modifier").at("properties");
  // What a track can have in place of keys, and what is no kind of curve.
  for (const char* track : {"track-number", "track-position", "track-degrees", "track-quat", "track-scale"})
    fields.update(definitions.at(track).at("properties"));
  for (const char* option : {"kind", "relative", "overlong", "ends", "influence"}) fields.erase(option);
  Json names = Json::array();
  for (const auto& [name, field] : fields.items()) names.push_back(name);
  check_words(names);
}
