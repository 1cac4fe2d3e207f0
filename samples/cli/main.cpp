// tweenfall: a thin program on the libraries. Exit codes are decided here; each verb has its file below verbs/.

#include "report/faults.h"
#include "report/terminal.h"
#include "verbs/verbs.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <new>
#include <string>
#include <vector>

namespace tweenfall::cli {

namespace {

constexpr const char* overview =
    "tweenfall: scripted and simulated motion on one timeline\n"
    "\n"
    "  tweenfall new first.json     write a commented document to start from\n"
    "  tweenfall check first.json   say what is wrong with it, and where\n"
    "  tweenfall view first.json    write first.html, the moving picture\n"
    "\n"
    "tweenfall --help lists all verbs, tweenfall VERB --help says more of one.\n";

/// If the caller has closed standard streams, newly opened files would get their numbers, and messages would be
/// written into them.
void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      // Read-only, so that printing a result to a closed stdout is still a fault.
      static_cast<void>(open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY));
}

int command(const std::vector<std::string>& arguments) {
  occupy_closed_streams();
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
    say_faults(error, "tweenfall");
    return 1;
  }
}

}  // namespace

}  // namespace tweenfall::cli

int main(int count, char** values) {
  return tweenfall::cli::command(std::vector<std::string>(values + 1, values + count));
}
