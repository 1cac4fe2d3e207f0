#include <tweenfall/importers/document.h>

#include "document/content.h"
#include "document/grammar/grammar.h"
#include "document/judge/judge.h"
#include "document/read/values.h"
#include "document/write/from_model.h"
#include "document/write/write.h"

#include <utility>

namespace tweenfall {

struct Document::Content {
  document::ReadDocument document;
};

Document::Document(std::shared_ptr<const Content> content) : content_(std::move(content)) {}

Document Document::read(const std::filesystem::path& file, const ReadOptions& options) {
  document::Reading reading{.options = options};
  return Document(std::make_shared<const Content>(Content{document::read_document_file(file, reading)}));
}

Document Document::parse(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                         const ReadOptions& options) {
  document::Reading reading{.options = options};
  // So that a file cannot import itself, even when its text was read by the caller.
  std::error_code fault;
  const std::filesystem::path own =
      std::filesystem::weakly_canonical(folder / std::filesystem::path(name).filename(), fault);
  if (!fault) reading.open.push_back(own);
  return Document(
      std::make_shared<const Content>(Content{document::read_document(std::string(text), name, folder, reading)}));
}

const StageDescription& Document::stage() const noexcept {
  return content_->document.stage;
}

const std::vector<ExpressionSystem>& Document::systems() const noexcept {
  return content_->document.systems;
}

const std::vector<Problem>& Document::notes() const noexcept {
  return content_->document.notes;
}

Problem Document::problem_of_node(std::size_t node, std::string message) const {
  const document::ReadDocument& read = content_->document;
  const json::Value place =
      document::judging::place_of_node(read.tree.root(), read.stage.nodes[node].name, read.names_are_free);
  document::Problems problems;
  problems.add(document::below(place, {"position"}), std::move(message));
  return problems.located(Severity::error, read.name, read.tree).front();
}

std::string Document::text() const {
  return document::write(document::document_form(), content_->document.tree.root());
}

Document Document::from_model(const Model& model) {
  return parse(document::text_of(model), model.name, {});
}

}  // namespace tweenfall
