#pragma once

/// The document: JSON written by people, checked once as a whole.
///
/// Reading gives either a `Document` or a `DocumentError` with all problems, each with its line and column, a pointer,
/// what is wrong and what would be right. A document keeps what its author wrote, so that writing it back gives the
/// same text; `stage` is what can be run.

#include <tweenfall/importers/model.h>
#include <tweenfall/physics/expression_system.h>
#include <tweenfall/physics/stage/description.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall {

/// A note is about something valid that may not be intended; an error is a fault for which a document is refused.
enum class Severity { error, note };

/// One message about a place in a document.
struct Problem {
  Severity severity = Severity::error;
  std::string file;      ///< as given
  std::size_t line = 0;  ///< from 1; 0 for the whole file
  std::size_t column = 0;
  std::string pointer;             ///< JSON pointer, "/clips/drop/..."
  std::string message;             ///< what is wrong, and the nearest valid name where there is one
  std::string excerpt;             ///< the line of the file; of a very long line the part around the place
  std::size_t excerpt_column = 1;  ///< column of the excerpt's first character
  std::size_t length = 1;          ///< of the place, bytes
  std::size_t count = 1;           ///< above 1 where it states how many others are not listed

  /// "file:line:column: error: message (at pointer)", or "note:", then the line and a caret, as compilers print it.
  /// Always UTF-8.
  [[nodiscard]] std::string text() const;
};

class DocumentError : public std::runtime_error {
 public:
  /// @param problems at least one @param notes notes made before the reader gave up
  explicit DocumentError(std::vector<Problem> problems, std::vector<Problem> notes = {});
  [[nodiscard]] const std::vector<Problem>& problems() const noexcept { return problems_; }  ///< only errors
  [[nodiscard]] const std::vector<Problem>& notes() const noexcept { return notes_; }

 private:
  std::vector<Problem> problems_, notes_;
};

/// Longer texts are not written by people, and are refused before they fill memory.
inline constexpr std::size_t largest_document = std::size_t{1} << 28;  // bytes

struct ReadOptions {
  bool allow_outside = false;  ///< imports may leave the document's folder
  bool try_steps = true;       ///< a copy of the stage is run for up to 256 steps, to note what would go wrong
};

class Document {
 public:
  // A move is a copy: that is just as cheap, and the object moved from stays valid.
  Document(const Document&) noexcept = default;
  Document& operator=(const Document&) noexcept = default;

  /// @throws DocumentError with all problems.
  [[nodiscard]] static Document read(const std::filesystem::path& file, const ReadOptions& options = {});
  /// @param name used for the file in problems
  /// @param folder  imports are relative to it
  [[nodiscard]] static Document parse(std::string_view text, const std::string& name,
                                      const std::filesystem::path& folder, const ReadOptions& options = {});

  /// Nodes, clips, bodies and rules, imports included.
  [[nodiscard]] const StageDescription& stage() const noexcept;

  /// The systems of first-order equations in it; each is also a clip of the stage.
  [[nodiscard]] const std::vector<ExpressionSystem>& systems() const noexcept;

  /// What its author may want to know although the document is valid: near misses of names, things too stiff or too
  /// fast for the step, bodies that start inside each other, bodies left out by a rule's pattern, losses from a model.
  [[nodiscard]] const std::vector<Problem>& notes() const noexcept;

  /// A problem found later with a node of `stage`, such as a position that no file can hold: the message with the
  /// node's place in the document, or that of the import that it came from.
  [[nodiscard]] Problem problem_of_node(std::size_t node, std::string message) const;

  /// The document as text: two spaces, one key per line, defaults left out. Reading and writing it again gives the same
  /// text.
  [[nodiscard]] std::string text() const;

  /// A document with a model's nodes and clips.
  [[nodiscard]] static Document from_model(const Model& model);

 private:
  struct Content;
  explicit Document(std::shared_ptr<const Content> content);
  std::shared_ptr<const Content> content_;
};

/// The JSON Schema (draft-07) of the document, as text.
[[nodiscard]] std::string document_schema();

/// A commented starting document.
[[nodiscard]] std::string starting_document();

}  // namespace tweenfall
