#include "command.h"

using namespace tweenfall::test;

namespace {

const std::vector<std::string> verbs{"check",  "inspect", "sample", "run",        "plot", "view",
                                     "import", "new",     "schema", "completion", "bench"};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("without arguments the command explains itself on stderr and ends with 2") {
  const Folder folder;
  const Ran ran = folder.run("");
  CHECK(ran.code == 2);
  CHECK(ran.out.empty());
  CHECK(holds(ran.err, "tweenfall check"));
  CHECK(holds(ran.err, "tweenfall view"));
}

TEST_CASE("every verb's help is on stdout, ends with 0 and holds an example of the verb") {
  const Folder folder;
  for (const std::string& verb : verbs) {
    CAPTURE(verb);
    const Ran ran = folder.run(verb + " --help");
    CHECK(ran.code == 0);
    CHECK(ran.err.empty());
    CHECK(holds(ran.out, "tweenfall " + verb));
    CHECK(holds(ran.out, "Example:"));
  }
  CHECK(holds(folder.run("run --help").out, "timed inputs to plays, graphs, vehicles and bodies"));
}

TEST_CASE("the overall help lists every verb and none of a later release") {
  const Folder folder;
  const Ran ran = folder.run("--help");
  CHECK(ran.code == 0);
  for (const std::string& verb : verbs) CHECK_MESSAGE(holds(ran.out, "\n  " + verb + " "), verb);
  CHECK(!holds(ran.out, "\n  fit "));
}

TEST_CASE("output that cannot be written is a fault of every verb, and of help") {
  if (!std::filesystem::exists("/dev/full")) {
    MESSAGE("SKIPPED: no /dev/full");
    return;
  }
  const Folder folder;
  folder.write("ball.json", ball_document);
  for (const std::string arguments :
       {"--help", "--version", "check --help", "check ball.json", "check ball.json --json", "inspect ball.json",
        "sample ball.json --at 0", "sample ball.json --at 0 --json", "run ball.json", "run ball.json --json",
        "run ball.json -o out.json", "plot ball.json", "plot ball.json -o out.svg", "view ball.json --until 0.1", "new",
        "schema", "completion bash"}) {
    CAPTURE(arguments);
    const Ran full = folder.shell(command_word() + " " + arguments + " > /dev/full");
    CHECK(full.code == 1);
    CHECK(holds(full.err, "standard output cannot be written"));
    const Ran closed = folder.shell(command_word() + " " + arguments + " >&-");
    CHECK(closed.code == 1);
  }
}

TEST_CASE("the version is printed") {
  const Folder folder;
  const Ran ran = folder.run("--version");
  CHECK(ran.code == 0);
  CHECK(ran.out.starts_with("tweenfall "));
}

TEST_CASE("wrong usage ends with 2, says what was probably meant, and prints no result") {
  struct Case {
    std::string arguments, says;
  };
  const Folder folder;
  folder.write("ball.json", ball_document);
  for (const Case& wrong : std::initializer_list<Case>{
           {"smaple ball.json --at 0", "did you mean sample?"},
           {"chek ball.json", "did you mean check?"},
           {"fit ball.json", "there is no verb \"fit\""},
           {"sample ball.json --att 0", "did you mean --at?"},
           {"sample ball.json --at 0 --rate", "did you mean --rates?"},
           {"run ball.json --ouput x.json", "did you mean --output?"},
           {"--verson", "did you mean --version?"},
           {"sample ball.json", "--at"},
           {"sample ball.json --at 0 --fps 3", "not both"},
           {"sample ball.json --at zero", "\"zero\" is not a number"},
           {"sample ball.json --at 0,,1", "is not a number"},
           {"sample ball.json --at nan", "\"nan\" is not a number"},
           {"sample ball.json --at 0 --clip rol", "did you mean roll?"},
           {"sample ball.json --at 0 --track bal.position", "did you mean ball.position?"},
           {"sample ball.json --fps 0", "--fps must be above 0"},
           {"sample ball.json --fps -5", "--fps must be above 0"},
           {"sample --at 0", "FILE"},
           {"check", "FILE"},
           {"run ball.json --until -1", "--until"},
           {"run ball.json --threads 0", "--threads must be a whole number from 1 to 256, not 0"},
           {"run ball.json --threads 2.5", "--threads must be a whole number from 1 to 256, not 2.5"},
           {"run ball.json --threads 257", "--threads"},
           {"run ball.json --until 1e9", "million frames"},
           {"run ball.json --until 1e8 --fps 0.001", "2.4e+10 steps"},
           {"run ball.json --until 30 --fps 50000", "million frames; give --fps 33333 or less"},
           {"run ball.json --until 600 --fps 1000 --limit 10", "MB of recording, above 10"},
           {"view ball.json --limit 0", "--limit must be above 0"},
           {"run ball.json -o moving.png", ".html"},
           {"run ball.json -o ball.json", "the file that is read"},
           {"plot ball.json -o ball.png", ".svg"},
           {"view ball.json -o ball.svg", ".html"},
           {"import ball.json -o other.json", "not a model"},
           {"sample ball.json --at 0 other.json", "other.json"},
           {"completion fihs", "did you mean fish?"},
       }) {
    CAPTURE(wrong.arguments);
    const Ran ran = folder.run(wrong.arguments);
    CHECK(ran.code == 2);
    CHECK(ran.out.empty());
    CHECK_MESSAGE(holds(ran.err, wrong.says), ran.err);
  }
  CHECK(folder.names() == std::vector<std::string>{"ball.json"});
}

TEST_CASE("the completion of bash is a script that bash takes and that completes verbs and options") {
  const Folder folder;
  const Ran ran = folder.run("completion bash");
  REQUIRE(ran.code == 0);
  folder.write("completion.bash", ran.out);
  folder.write("ask.bash",
               "source completion.bash\n"
               "COMP_WORDS=(tweenfall sam); COMP_CWORD=1; _tweenfall; echo ${COMPREPLY[@]}\n"
               "COMP_WORDS=(tweenfall sample --ra); COMP_CWORD=2; _tweenfall; echo ${COMPREPLY[@]}\n");
  const std::string line = "cd '" + folder.path().string() + "' && bash ask.bash > answer 2>&1";
  CHECK(std::system(line.c_str()) == 0);
  CHECK(folder.read("answer") == "sample\n--rates\n");
}

TEST_CASE("fish is told which options take a value") {
  const Folder folder;
  const std::string fish = folder.run("completion fish").out;
  CHECK(holds(fish, "-l clip -r -d"));
  CHECK(holds(fish, "-l rates -d"));
}

TEST_CASE("the completions of zsh and fish name every verb") {
  const Folder folder;
  for (const char* shell : {"zsh", "fish"}) {
    const Ran ran = folder.run(std::string("completion ") + shell);
    CHECK(ran.code == 0);
    for (const std::string& verb : verbs) CHECK_MESSAGE(holds(ran.out, verb), verb);
  }
}

TEST_CASE("color comes on a terminal, not with NO_COLOR and not in a pipe") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  if (std::system("script --version > /dev/null 2>&1") != 0) {
    MESSAGE("SKIPPED: no script program to make a terminal");
    return;
  }
  CHECK(holds(folder.run_on_terminal("inspect ball.json", ""), "\033["));
  CHECK(!holds(folder.run_on_terminal("inspect ball.json", "NO_COLOR=1"), "\033["));
  CHECK(!holds(folder.run("inspect ball.json").out, "\033["));
  CHECK(holds(folder.run_on_terminal("check none.json", ""), "\033["));
  CHECK(!holds(folder.run_on_terminal("check none.json", "NO_COLOR=1"), "\033["));
}

TEST_CASE("a verb that there is not is sent to the help, and a file that is not there is told alike by all verbs") {
  const Folder folder;
  CHECK(holds(folder.run("help").err, "tweenfall --help says what they do"));
  CHECK(holds(folder.run("check nothing.json").err, "nothing.json: error: there is no such file"));
  CHECK(holds(folder.run("import nothing.glb").err, "nothing.glb: error: there is no such file"));
}
