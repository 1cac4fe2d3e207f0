#include "document/fields/things.h"
#include "document/grammar/grammar_parts.h"
#include "document/report/spellings.h"

#include <utility>

namespace tweenfall::document {

namespace {

const Form* event_form(FormStore& store, const ValueForms& values) {
  Form row;
  row.kind = Form::Kind::tuple;
  row.what = "an event: [time, name], [time, name, data] or {\"from\", \"to\", \"name\"}";
  row.parts = {values.key_time, values.name, values.any};
  row.fewest = 2;
  row.on_one_line = true;
  Form span = object_of(row.what, {{"from", values.key_time, "clip time", true},
                                   {"to", values.key_time, "clip time", true},
                                   {"name", values.name, "", true},
                                   {"data", values.any, "given with the event"}});
  span.on_one_line = true;
  span.foremost_fault = event_meant;
  Form either = choice_of(row.what, {store.add(row), store.add(span)});
  either.definition = "event";
  return store.add(std::move(either));
}

}  // namespace

const Form* clip_form(FormStore& store, const ValueForms& values) {
  Form events = list_of(event_form(store, values), "a list of events", 0);
  events.one_per_line = true;
  Form clip = object_of("a clip: {\"duration\", \"loop\", \"tracks\", \"events\"}",
                        {{"duration", values.length_of_time, "absent: the latest key or event"},
                         {"loop", fields::loop_form(store, values), "absent: once"},
                         {"tracks", tracks_form(store, values), "", false, "{}"},
                         {"events", store.add(std::move(events)), "", false, "[]", {"markers", "notifies", "cues"}}});
  clip.definition = "clip";
  clip.one_per_line = true;
  return store.add(std::move(clip));
}

}  // namespace tweenfall::document
