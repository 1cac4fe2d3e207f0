#include "fbx/placement.h"

namespace tweenfall::fbx {

namespace {

/// About the fixed axes, x first for XYZ. Source: Autodesk, FBX SDK, FbxEuler::EOrder.
EulerOrder order_of(std::int64_t number) {
  constexpr int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}};
  EulerOrder order;
  order.intrinsic = false;
  // Orders beyond these ("spherical") count as XYZ.
  const auto& axes = orders[number >= 0 && number < 6 ? number : 0];
  for (int i = 0; i < 3; ++i) order.axes[i] = axes[i];
  return order;
}

bool turns_nothing(const Channel<Quat>& rotation) {
  return !rotation.driven && rotation.curve.value(0).vec().isZero(0);
}

bool moves_nothing(const Channel<Vec3>& offset) {
  return !offset.driven && offset.curve.value(0).isZero(0);
}

Channel<Quat> rotation_of(const Objects& objects, std::size_t index, const Stack* stack) {
  const Object& object = objects[index];
  const bool own_space =
      objects.whole(object, "RotationActive", 1) != 0 && objects.whole(object, "RotationSpaceForLimitOnly", 0) == 0;
  const EulerOrder plain = order_of(0);
  if (!own_space) return rotation_channel(objects, index, "Lcl Rotation", plain, stack);
  const EulerOrder order = order_of(objects.whole(object, "RotationOrder", 0));
  const Channel<Quat> own = rotation_channel(objects, index, "Lcl Rotation", order, stack);
  const Channel<Quat> before = rotation_channel(objects, index, "PreRotation", plain, stack);
  const Channel<Quat> after = rotation_channel(objects, index, "PostRotation", plain, stack);
  if (turns_nothing(before) && turns_nothing(after)) return own;
  return {composed<Quat>(
              [pre = before.curve, mid = own.curve, post = after.curve](double at, Side side) {
                return product(product(pre.sample(at, side), mid.sample(at, side)), inverse(post.sample(at, side)));
              },
              Knots().of(before.curve).of(own.curve).of(after.curve)),
          before.driven || own.driven || after.driven};
}

}  // namespace

Placement placement(const Objects& objects, std::size_t object, const Stack* stack) {
  const Vec3 none(0, 0, 0);
  const auto offset = [&](const char* name) { return vector_channel(objects, object, name, none, stack); };
  Placement result{offset("Lcl Translation"), rotation_of(objects, object, stack),
                   vector_channel(objects, object, "Lcl Scaling", Vec3(1, 1, 1), stack)};
  const Channel<Vec3> moved = offset("RotationOffset"), about = offset("RotationPivot");
  const Channel<Vec3> scale_moved = offset("ScalingOffset"), scale_about = offset("ScalingPivot");
  if (moves_nothing(moved) && moves_nothing(about) && moves_nothing(scale_moved) && moves_nothing(scale_about))
    return result;
  const bool turned_offset = !(moves_nothing(about) && moves_nothing(scale_moved) && moves_nothing(scale_about));
  Knots knots;
  knots.of(result.position.curve).of(moved.curve).of(about.curve).of(scale_moved.curve).of(scale_about.curve);
  if (turned_offset) knots.of(result.rotation.curve).of(result.scale.curve);
  const bool driven = result.position.driven || moved.driven || about.driven || scale_moved.driven ||
                      scale_about.driven || (turned_offset && (result.rotation.driven || result.scale.driven));
  result.position = {
      composed<Vec3>(
          [t = result.position.curve, q = result.rotation.curve, s = result.scale.curve, r_off = moved.curve,
           r_pivot = about.curve, s_off = scale_moved.curve, s_pivot = scale_about.curve](double at, Side side) {
            const Sample<Vec3> pivot = r_pivot.sample(at, side), center = s_pivot.sample(at, side);
            const Sample<Vec3> inner =
                difference(sum(s_off.sample(at, side), center), sum(product(s.sample(at, side), center), pivot));
            return sum(sum(sum(t.sample(at, side), r_off.sample(at, side)), pivot), turned(q.sample(at, side), inner));
          },
          knots),
      driven};
  return result;
}

}  // namespace tweenfall::fbx
