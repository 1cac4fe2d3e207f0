#include "document/tracks/read_keys.h"

namespace tweenfall::document {

TangentKind tangent_kind_of(std::string_view word) {
  static constexpr std::pair<std::string_view, TangentKind> words[] = {{"flat", TangentKind::flat},
                                                                       {"vector", TangentKind::vector},
                                                                       {"aligned", TangentKind::aligned},
                                                                       {"mirrored", TangentKind::mirrored},
                                                                       {"plateau", TangentKind::plateau},
                                                                       {"auto-clamped", TangentKind::auto_clamped},
                                                                       {"auto-chord", TangentKind::auto_chord},
                                                                       {"auto-mix", TangentKind::auto_mix},
                                                                       {"auto-ease", TangentKind::auto_ease}};
  for (const auto& [name, kind] : words)
    if (word == name) return kind;
  return TangentKind::automatic;
}

KeyOptions key_options_of(const json::Value& track, KeyOptions options) {
  const std::string overlong = text_in(track, "overlong"), ends = text_in(track, "ends");
  if (overlong == "keep-start") options.overlong = Overlong::keep_start;
  if (overlong == "contain") options.overlong = Overlong::contain;
  if (ends == "flat") options.ends = Ends::flat;
  if (ends == "wrap") options.ends = Ends::wrap;
  return options;
}

}  // namespace tweenfall::document
