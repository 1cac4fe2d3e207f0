// tweenfall: a thin program on the libraries. Here are the table of verbs and the exit codes; each verb has its file.

#include "faults.h"
#include "terminal.h"
#include "verbs.h"

#include <exception>
#include <new>
#include <string>
#include <vector>

namespace tweenfall::cli {

namespace {

constexpr Verb verbs[] = {
    {"check", "validate documents and models; print every problem with its place", "tweenfall check swing.json", check},
    {"inspect", "tables of nodes, clips, tracks, speeds, jumps and bodies, of documents and models",
     "tweenfall inspect Fox.glb", inspect},
    {"sample", "evaluate a clip's tracks, and where its nodes are in the world",
     "tweenfall sample swing.json --at 0,0.25,0.5 --rates", sample},
    {"run", "advance the stage with physics: a summary, or a recording as .json .csv .svg .html .glb",
     "tweenfall run swing.json --until 3 -o swing.glb", run},
    {"plot", "draw curves with keys, tangents, rates, events and hand-offs as SVG",
     "tweenfall plot swing.json -o swing.svg", plot},
    {"view", "write the moving picture as one HTML page", "tweenfall view swing.json -o swing.html", view},
    {"import", "turn a model's nodes and clips into a document", "tweenfall import Fox.glb -o fox.json", import_model},
    {"new", "write a commented starting document", "tweenfall new first.json", new_document},
    {"schema", "print the JSON Schema of documents", "tweenfall schema > tweenfall.schema.json", schema},
    {"completion", "print the completion of a shell", "source <(tweenfall completion bash)", completion},
    {"bench", "time sampling and stepping on this machine", "tweenfall bench", bench},
};

constexpr const char* overview =
    "tweenfall: scripted and simulated motion on one timeline\n"
    "\n"
    "  tweenfall new first.json     write a commented document to start from\n"
    "  tweenfall check first.json   say what is wrong with it, and where\n"
    "  tweenfall view first.json    write first.html, the moving picture\n"
    "\n"
    "tweenfall --help lists all verbs, tweenfall VERB --help says more of one.\n";

int command(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    say(overview);
    return 2;
  }
  try {
    CommandLine line(all_verbs());
    return line.run(arguments);
  } catch (const UsageError& error) {
    say(std::string("tweenfall: error: ") + error.what());
    return 2;
  } catch (const std::bad_alloc&) {
    say("tweenfall: error: not enough memory");
    return 1;
  } catch (const std::exception& error) {
    say_faults(faults_of(error, "tweenfall"));
    return 1;
  }
}

}  // namespace

std::span<const Verb> all_verbs() {
  return verbs;
}

}  // namespace tweenfall::cli

int main(int count, char** values) {
  return tweenfall::cli::command(std::vector<std::string>(values + 1, values + count));
}
