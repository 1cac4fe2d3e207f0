#include "recording/words.h"

#include <tweenfall/importers/recording_file.h>

namespace tweenfall {

const char* owner_word(Owner owner) noexcept {
  switch (owner) {
    case Owner::keyed:
      return "keyed";
    case Owner::driven:
      return "driven";
    case Owner::free:
      break;
  }
  return "free";
}

const char* cause_word(Cause cause) noexcept {
  switch (cause) {
    case Cause::start:
      return "start";
    case Cause::at:
      return "at";
    case Cause::marker:
      return "marker";
    case Cause::event:
      return "event";
    case Cause::clip_end:
      return "clip-end";
    case Cause::contact:
      return "contact";
    case Cause::asleep:
      return "asleep";
    case Cause::enter:
      return "enter";
    case Cause::leave:
      return "leave";
    case Cause::saturated:
      return "saturated";
    case Cause::error:
      return "error";
    case Cause::speed_peak:
      return "speed-peak";
    case Cause::then:
      return "then";
    case Cause::ramp:
      return "ramp";
    case Cause::caller:
      break;
  }
  return "caller";
}

namespace recordings {

const char* kind_word(EventKind kind) noexcept {
  switch (kind) {
    case EventKind::begin:
      return "begin";
    case EventKind::end:
      return "end";
    case EventKind::moment:
      break;
  }
  return "";
}

}  // namespace recordings
}  // namespace tweenfall
