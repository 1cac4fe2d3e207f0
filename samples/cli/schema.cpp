// tweenfall schema: what editors complete documents from.

#include "terminal.h"
#include "verbs.h"

#include <tweenfall/importers/document.h>

namespace tweenfall::cli {

Run schema(Arguments&) {
  return [] {
    print(document_schema());
    return 0;
  };
}

}  // namespace tweenfall::cli
