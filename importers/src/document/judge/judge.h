#pragma once

// Judges a document without faults as a whole: the effect of its parts together. A finding is an error if the stage
// would refuse to run, else a note.

#include "document/content.h"

namespace tweenfall::document::judging {

// The place in the document of a part of the stage; for imported parts, the import.
[[nodiscard]] json::Value place_of_node(const json::Value& root, const std::string& node, bool names_are_free);
[[nodiscard]] json::Value place_of_node(const Building& building, std::size_t node);
[[nodiscard]] json::Value place_of_joint(const Building& building, std::size_t joint);
[[nodiscard]] json::Value place_of_clip(const Building& building, const std::string& clip);
// The track, or the clip where it has none of that name.
[[nodiscard]] json::Value place_of_track(const Building& building, const Clip& clip, const Track& track);
[[nodiscard]] json::Value place_of_world(const Building& building);

void judge_stage(Building& building);   // what the stage refuses, and bad starts
void judge_pace(Building& building);    // what is too fast or too long for the step
void judge_tracks(Building& building);  // names of properties
void judge_angles(Building& building);  // radians among the degrees
void judge_drives(Building& building);  // tracks that drive bodies
void judge_sizes(Building& building);   // tracks that scale a mesh but not its collider
void judge_frames(Building& building);  // drives in a frame that nothing carries
void judge_actors(Building& building);  // settings of particles and soft bodies without effect

}  // namespace tweenfall::document::judging
