// tweenfall schema: the schema by which editors complete documents.

#include "report/terminal.h"
#include "verbs/verbs.h"

#include <tweenfall/importers/document.h>

namespace tweenfall::cli {

namespace {

Run declare_schema(Arguments&) {
  return [] {
    print(document_schema());
    return 0;
  };
}

}  // namespace

const Verb schema_verb{"schema", "print the JSON Schema of documents", "tweenfall schema > tweenfall.schema.json",
                       declare_schema};

}  // namespace tweenfall::cli
