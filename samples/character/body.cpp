#include "body.h"

#include "loft.h"
#include "skeleton.h"

#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::character {

namespace {

double smooth_step(double from, double to, double x) {
  const double u = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

// The joints along a limb, and where each hands over to the next.
struct Handover {
  Joint to;
  double at;          // m along the limb
  double half_width;  // m; within it, both share the skin
};

Influence pull_of(Joint joint, double weight) {
  return {static_cast<std::uint32_t>(joint), weight};
}

Pulls along_chain(Joint first, std::initializer_list<Handover> chain, double position) {
  Pulls pulls{pull_of(first, 1)};
  for (const Handover& next : chain) {
    const double share = smooth_step(next.at - next.half_width, next.at + next.half_width, position);
    if (share <= 0) break;
    if (share < 1) {
      pulls[0].weight = 1 - share;
      pulls.push_back(pull_of(next.to, share));
      break;
    }
    pulls = {pull_of(next.to, 1)};
  }
  return pulls;
}

// Lets one more joint take `share` of the point.
void give(Pulls& pulls, Joint joint, double share) {
  if (share <= 0) return;
  for (Influence& pull : pulls) pull.weight *= 1 - share;
  pulls.push_back(pull_of(joint, share));
}

Pulls pulls_on_trunk(const Vec3& p) {
  Pulls pulls =
      along_chain(hips, {{spine, 1.045, 0.06}, {chest, 1.18, 0.065}, {neck, 1.455, 0.04}, {head, 1.54, 0.03}}, p.y());
  const double sideways = smooth_step(0.05, 0.17, std::abs(p.x()));
  const double at_shoulder = 0.75 * sideways * smooth_step(1.27, 1.4, p.y());
  give(pulls, p.x() > 0 ? left_shoulder : right_shoulder, at_shoulder);
  const double at_thigh = 0.5 * smooth_step(0.02, 0.12, std::abs(p.x())) * (1 - smooth_step(0.84, 0.96, p.y()));
  give(pulls, p.x() > 0 ? left_thigh : right_thigh, at_thigh);
  return pulls;
}

void add_trunk(Mesh& mesh) {
  Loft loft{.around = 24, .rings = 22};
  const auto section = [&](double y, double z, double width, double front, double back, double roundness = 2.2) {
    loft.sections.push_back({{0, y, z}, width, front, back, roundness});
  };
  section(0.865, -0.004, 0.112, 0.078, 0.094);
  section(0.90, -0.005, 0.158, 0.098, 0.120);
  section(0.94, -0.006, 0.165, 0.105, 0.122);
  section(0.98, -0.006, 0.157, 0.102, 0.110);
  section(1.03, -0.005, 0.139, 0.096, 0.094);
  section(1.09, -0.004, 0.124, 0.090, 0.086);
  section(1.15, -0.004, 0.128, 0.091, 0.090);
  section(1.22, -0.005, 0.149, 0.100, 0.098);
  section(1.29, -0.007, 0.168, 0.109, 0.105);
  section(1.345, -0.009, 0.182, 0.106, 0.104);
  section(1.385, -0.010, 0.186, 0.090, 0.094);
  section(1.415, -0.010, 0.158, 0.074, 0.080, 2);
  section(1.44, -0.008, 0.104, 0.062, 0.068, 2);
  section(1.468, -0.004, 0.064, 0.053, 0.056, 2);
  section(1.50, 0.000, 0.048, 0.048, 0.048, 2);
  section(1.56, 0.008, 0.046, 0.046, 0.046, 2);
  loft.start_cap = 0.045;
  loft.end_cap = 0.02;
  add_loft(mesh, loft, pulls_on_trunk);
}

double bell(const Vec3& p, const Vec3& center, double width) {
  return elementary::exp(-(p - center).squaredNorm() / (2 * width * width));
}

// Brows, eye hollows and a chin pressed into the egg.
Vec3 sculpt_face(const Vec3& p) {
  Vec3 q = p;
  if (p.z() > 0.03) {
    const double hollows = bell(p, {0.036, 1.632, 0.096}, 0.017) + bell(p, {-0.036, 1.632, 0.096}, 0.017);
    q.z() -= 0.011 * hollows;
    q.z() += 0.007 * bell(p, {0, 1.535, 0.085}, 0.02);
    q.z() += 0.004 * bell(p, {0, 1.665, 0.1}, 0.03);
  }
  return q;
}

void add_head(Mesh& mesh) {
  const Weighting rigid = [](const Vec3& p) { return along_chain(neck, {{head, 1.51, 0.02}}, p.y()); };
  Loft egg{.around = 24, .rings = 10, .cap_rings = 4};
  const auto section = [&](double y, double z, double width, double front, double back) {
    egg.sections.push_back({{0, y, z}, width, front, back, 2.15});
  };
  section(1.512, 0.028, 0.050, 0.056, 0.064);
  section(1.545, 0.021, 0.069, 0.078, 0.084);
  section(1.585, 0.015, 0.082, 0.091, 0.100);
  section(1.63, 0.008, 0.091, 0.100, 0.110);
  section(1.655, 0.005, 0.092, 0.100, 0.111);
  egg.start_cap = 0.014;
  egg.end_cap = 0.088;
  add_loft(mesh, egg, rigid, sculpt_face);

  Loft nose{.start_cap = 0.004, .end_cap = 0.009, .around = 8, .rings = 5, .cap_rings = 2};
  nose.sections = {{{0, 1.642, 0.098}, 0.007, 0.008, 0.02},
                   {{0, 1.618, 0.109}, 0.010, 0.010, 0.02},
                   {{0, 1.602, 0.113}, 0.014, 0.012, 0.02}};
  add_loft(mesh, nose, rigid);
  Loft smile{.side = {0, 0, 1},
             .up = {0, 1, 0},
             .start_cap = 0.004,
             .end_cap = 0.004,
             .around = 6,
             .rings = 7,
             .cap_rings = 1};
  for (const double x : {-0.03, -0.018, 0.0, 0.018, 0.03})
    smile.sections.push_back({{x, 1.556 + 14 * x * x, 0.1015 - 8 * x * x}, 0.005, 0.004, 0.004});
  add_loft(mesh, smile, rigid);
  for (const double sign : {1.0, -1.0}) {
    Loft eye{.start_cap = 0.008, .end_cap = 0.008, .around = 8, .rings = 3, .cap_rings = 2};
    for (const double y : {1.629, 1.635, 1.641})
      eye.sections.push_back({{sign * 0.035, y, 0.083}, 0.0115, 0.0145, 0.01});
    add_loft(mesh, eye, rigid);
    Loft ear{.side = {0, 0, 1},
             .up = {sign, 0, 0},
             .start_cap = 0.008,
             .end_cap = 0.008,
             .around = 10,
             .rings = 5,
             .cap_rings = 2};
    ear.sections = {{{sign * 0.088, 1.585, 0.004}, 0.011, 0.008, 0.012},
                    {{sign * 0.092, 1.607, -0.002}, 0.017, 0.011, 0.012},
                    {{sign * 0.093, 1.634, -0.006}, 0.020, 0.012, 0.012}};
    add_loft(mesh, ear, rigid);
  }
}

void add_arm(Mesh& mesh, Flank flank) {
  const Arm arm = arm_of(flank);
  const Vec3 root = bind_position(arm.upper);
  const Vec3 along = bind_offset(arm.forearm).normalized();
  const Vec3 outwards(-along.y() * sign_of(flank), along.x() * sign_of(flank), 0);
  const auto at = [&](double length, double out, double front) {
    return Vec3(root + along * length + outwards * out + Vec3(0, 0, front));
  };
  const Weighting weighting = [&](const Vec3& p) {
    return along_chain(arm.shoulder, {{arm.upper, -0.012, 0.05}, {arm.forearm, 0.28, 0.05}, {arm.hand, 0.53, 0.03}},
                       (p - root).dot(along));
  };
  // Widths lie along the thumb's side, depths across the palm.
  const Vec3 thumb_side(0, 0, 1);
  Loft limb{.side = thumb_side, .up = outwards, .start_cap = 0.05, .end_cap = 0.012, .around = 12, .rings = 23};
  const auto section = [&](double length, double out, double width, double front, double back, double roundness = 2) {
    limb.sections.push_back({at(length, out, 0), width, front, back, roundness});
  };
  section(-0.01, -0.008, 0.052, 0.046, 0.046);
  section(0.025, -0.004, 0.057, 0.052, 0.052);
  section(0.08, 0, 0.053, 0.050, 0.048);
  section(0.15, 0, 0.047, 0.046, 0.044);
  section(0.22, 0, 0.042, 0.041, 0.041);
  section(0.255, 0, 0.040, 0.039, 0.039);
  section(0.28, 0, 0.043, 0.042, 0.042);
  section(0.315, 0, 0.042, 0.040, 0.040);
  section(0.36, 0, 0.043, 0.040, 0.040);
  section(0.43, 0, 0.037, 0.033, 0.033);
  section(0.50, 0, 0.030, 0.025, 0.025);
  section(0.53, 0, 0.031, 0.024, 0.024);
  section(0.56, 0, 0.039, 0.022, 0.023, 2.4);
  section(0.595, 0, 0.044, 0.021, 0.022, 2.6);
  section(0.625, -0.003, 0.042, 0.018, 0.020, 2.6);
  add_loft(mesh, limb, weighting);

  constexpr double finger_side[] = {0.031, 0.0105, -0.0105, -0.031}, finger_length[] = {0.076, 0.084, 0.08, 0.064};
  for (int i = 0; i < 4; ++i) {
    Loft finger{.side = thumb_side,
                .up = outwards,
                .start_cap = 0.01,
                .end_cap = 0.009,
                .around = 6,
                .rings = 4,
                .cap_rings = 2};
    const double side = finger_side[i], length = finger_length[i];
    finger.sections = {{at(0.62, -0.003, side), 0.0108, 0.0108, 0.0108},
                       {at(0.62 + 0.5 * length, -0.007, side * 1.02), 0.0104, 0.0104, 0.0104},
                       {at(0.62 + 0.98 * length, -0.022, side * 0.95), 0.0088, 0.0088, 0.0088}};
    add_loft(mesh, finger, weighting);
  }
  Loft thumb{.side = thumb_side,
             .up = outwards,
             .start_cap = 0.012,
             .end_cap = 0.011,
             .around = 6,
             .rings = 5,
             .cap_rings = 2};
  thumb.sections = {{at(0.555, -0.004, 0.024), 0.0165, 0.015, 0.015},
                    {at(0.59, -0.012, 0.047), 0.0135, 0.0135, 0.0135},
                    {at(0.632, -0.018, 0.060), 0.0112, 0.0112, 0.0112}};
  add_loft(mesh, thumb, weighting);
}

void add_leg(Mesh& mesh, Flank flank) {
  const Leg leg = leg_of(flank);
  const double x = bind_position(leg.thigh).x();
  const Weighting weighting = [&](const Vec3& p) {
    return along_chain(hips, {{leg.thigh, -0.925, 0.06}, {leg.shin, -0.5, 0.06}, {leg.foot, -0.085, 0.03}}, -p.y());
  };
  Loft limb{.start_cap = 0.04, .end_cap = 0.03, .around = 14, .rings = 21};
  const auto section = [&](double y, double z, double width, double front, double back) {
    limb.sections.push_back({{x, y, z}, width, front, back, 2});
  };
  section(0.93, 0, 0.048, 0.060, 0.066);
  section(0.90, 0, 0.072, 0.078, 0.090);
  section(0.865, 0, 0.080, 0.086, 0.095);
  section(0.82, 0.002, 0.083, 0.087, 0.089);
  section(0.73, 0.004, 0.076, 0.082, 0.076);
  section(0.63, 0.010, 0.064, 0.070, 0.064);
  section(0.55, 0.016, 0.054, 0.058, 0.054);
  section(0.50, 0.020, 0.054, 0.060, 0.052);
  section(0.45, 0.014, 0.050, 0.052, 0.052);
  section(0.38, 0.004, 0.052, 0.046, 0.064);
  section(0.31, -0.004, 0.049, 0.044, 0.058);
  section(0.22, -0.010, 0.039, 0.039, 0.043);
  section(0.13, -0.014, 0.033, 0.036, 0.036);
  section(0.085, -0.015, 0.035, 0.040, 0.040);
  add_loft(mesh, limb, weighting);
}

void add_foot(Mesh& mesh, Flank flank) {
  const Leg leg = leg_of(flank);
  const double x = bind_position(leg.foot).x(), sign = sign_of(flank);
  const Weighting weighting = [&](const Vec3& p) { return along_chain(leg.foot, {{leg.toes, 0.105, 0.025}}, p.z()); };
  Loft foot{.up = {0, 1, 0}, .start_cap = 0.02, .end_cap = 0.03, .around = 14, .rings = 11};
  // The lower half is boxy, and as deep as the center is high: a flat sole on the floor.
  const auto section = [&](double z, double out, double width, double top) {
    foot.sections.push_back({{x + sign * out, 0.028, z}, width, top - 0.028, 0.028, 2.9});
  };
  section(-0.072, 0, 0.030, 0.066);
  section(-0.045, 0, 0.038, 0.088);
  section(-0.01, 0.001, 0.040, 0.104);
  section(0.03, 0.003, 0.043, 0.094);
  section(0.07, 0.006, 0.048, 0.072);
  section(0.11, 0.008, 0.050, 0.058);
  section(0.145, 0.006, 0.045, 0.048);
  section(0.16, 0.004, 0.039, 0.044);
  add_loft(mesh, foot, weighting);
}

}  // namespace

Mesh make_body() {
  Mesh mesh;
  mesh.name = "Body";
  mesh.base_color = {Vec4{0.78, 0.52, 0.30, 1}};
  add_trunk(mesh);
  add_head(mesh);
  for (const Flank flank : {Flank::left, Flank::right}) {
    add_arm(mesh, flank);
    add_leg(mesh, flank);
    add_foot(mesh, flank);
  }
  return mesh;
}

}  // namespace tweenfall::character
