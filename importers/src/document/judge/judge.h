#pragma once

// A document without faults of its own, judged as a whole: what its parts make together. What it finds is an error
// where the stage would refuse to run, else a note.

#include "document/content.h"

namespace tweenfall::document::judging {

// Where a part of the stage is written; for what an import brought, the import.
[[nodiscard]] json::Value place_of_node(const json::Value& root, const std::string& node, bool names_are_free);
[[nodiscard]] json::Value place_of_node(const Building& building, std::size_t node);
[[nodiscard]] json::Value place_of_joint(const Building& building, std::size_t joint);
[[nodiscard]] json::Value place_of_clip(const Building& building, const std::string& clip);
// The track, or the clip where it has none of that name.
[[nodiscard]] json::Value place_of_track(const Building& building, const Clip& clip, const Track& track);
[[nodiscard]] json::Value place_of_world(const Building& building);

void judge_stage(Building& building);   // what the stage refuses, what starts badly
void judge_pace(Building& building);    // what is too fast or too long for the step
void judge_tracks(Building& building);  // names of properties
void judge_angles(Building& building);  // radians among the degrees
void judge_drives(Building& building);  // tracks that drive bodies
void judge_sizes(Building& building);   // tracks that scale what is drawn and not what collides
void judge_frames(Building& building);  // drives that nothing carries along
void judge_actors(Building& building);  // what particles and soft bodies say in vain

}  // namespace tweenfall::document::judging
