#include "assimp/model_stream.h"

#include <tweenfall/curves/keys.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace tweenfall::assimp {

namespace {

constexpr std::string_view first_word = "tweenfall model 1\n";
constexpr std::string_view last_word = "\nend of model\n";

class Writer {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void put(T value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  }
  void put(const std::string& text) {
    put(std::uint64_t{text.size()});
    bytes += text;
  }
  template <int rows>
  void put(const Eigen::Matrix<double, rows, 1, Eigen::DontAlign>& v) {
    for (int i = 0; i < rows; ++i) put(v[i]);
  }
  void put(const Quat& q) { put(Vec4(q.x(), q.y(), q.z(), q.w())); }
  void put(const Mat3& m) {
    for (int i = 0; i < 9; ++i) put(m(i % 3, i / 3));
  }
  template <class List, class Put>
  void list(const List& all, Put each) {
    put(std::uint64_t{all.size()});
    for (std::size_t i = 0; i < all.size(); ++i) each(all[i]);
  }
  template <class T>
  void list(const std::vector<T>& all) {
    list(all, [&](const T& each) { put(each); });
  }
  template <class T>
  void curve(const Curve<T>& c) {
    const auto knots = c.knots();
    put(std::uint64_t{knots.size()});
    if (knots.empty()) put(c.value(0));
    for (const double knot : knots) {
      put(knot);
      put(c.value(knot));
    }
  }

  std::string bytes;
};

/// Thrown only within this file.
struct Broken {};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  void get(auto& value) requires std::is_arithmetic_v<std::remove_reference_t<decltype(value)>> {
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
  }
  void get(std::string& text) { text = std::string(take(count(1))); }
  template <int rows>
  void get(Eigen::Matrix<double, rows, 1, Eigen::DontAlign>& v) {
    for (int i = 0; i < rows; ++i) {
      get(v[i]);
      if (!std::isfinite(v[i])) throw Broken();
    }
  }
  void get(Quat& q) {
    Vec4 v;
    get(v);
    q = Quat(v[3], v[0], v[1], v[2]);
  }
  void get(Mat3& m) {
    for (int i = 0; i < 9; ++i) {
      get(m(i % 3, i / 3));
      if (!std::isfinite(m(i % 3, i / 3))) throw Broken();
    }
  }
  /// A count of elements of at least `least` bytes each, which must still be there.
  std::size_t count(std::size_t least) {
    std::uint64_t stated = 0;
    get(stated);
    if (stated > (bytes_.size() - at_) / least) throw Broken();
    return static_cast<std::size_t>(stated);
  }
  template <class T, class Get>
  void list(std::vector<T>& all, std::size_t least, Get each) {
    all.resize(count(least));
    for (T& one : all) each(one);
  }
  template <class T>
  void list(std::vector<T>& all) {
    list(all, sizeof(T) < 8 ? sizeof(T) : 8, [&](T& each) { get(each); });
  }
  template <class T>
  Curve<T> curve() {
    const std::size_t keys = count(8 + sizeof(double));
    const Ease straight = Ease::linear();
    std::vector<Key<T>> all;
    T value;
    if (keys == 0) {
      get(value);
      return Curve<T>(value);
    }
    for (std::size_t i = 0; i < keys; ++i) {
      double time = 0;
      get(time);
      get(value);
      all.push_back({.time = time, .value = value, .ease = straight});
    }
    return keyed_curve<T>(std::span<const Key<T>>(all));
  }
  std::string_view take(std::size_t size) {
    if (size > bytes_.size() - at_) throw Broken();
    const std::string_view part = bytes_.substr(at_, size);
    at_ += size;
    return part;
  }
  void expect(std::string_view word) {
    if (take(word.size()) != word) throw Broken();
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

void put_mesh(const Mesh& mesh, Writer& to) {
  to.put(mesh.name);
  to.list(mesh.positions);
  to.list(mesh.normals);
  to.list(mesh.tangents);
  to.list(mesh.texture_coordinates);
  to.list(mesh.triangles);
  to.list(mesh.influences, [&](std::span<const Influence> pulls) {
    to.list(pulls, [&](const Influence& pull) {
      to.put(pull.joint);
      to.put(pull.weight);
    });
  });
  to.list(mesh.morphs, [&](const MorphTarget& morph) {
    to.put(morph.name);
    to.list(morph.position_offsets);
    to.list(morph.normal_offsets);
  });
  to.list(mesh.rest_weights);
  to.put(mesh.base_color.rgba);
}

Mesh mesh_from(Reader& from) {
  Mesh mesh;
  from.get(mesh.name);
  from.list(mesh.positions);
  from.list(mesh.normals);
  from.list(mesh.tangents);
  from.list(mesh.texture_coordinates);
  from.list(mesh.triangles);
  const std::size_t bound = from.count(8), points = mesh.positions.size();
  for (std::size_t i = 0; i < bound; ++i) {
    std::vector<Influence> pulls;
    from.list(pulls, 12, [&](Influence& pull) {
      from.get(pull.joint);
      from.get(pull.weight);
    });
    mesh.influences.add(pulls);
  }
  from.list(mesh.morphs, 24, [&](MorphTarget& morph) {
    from.get(morph.name);
    from.list(morph.position_offsets);
    from.list(morph.normal_offsets);
    if (morph.position_offsets.size() != points) throw Broken();
    if (!morph.normal_offsets.empty() && morph.normal_offsets.size() != mesh.normals.size()) throw Broken();
  });
  from.list(mesh.rest_weights);
  from.get(mesh.base_color.rgba);
  const auto fits = [points](std::size_t size) { return size == 0 || size == points; };
  if (!fits(mesh.normals.size()) || !fits(mesh.tangents.size()) || !fits(mesh.texture_coordinates.size()) ||
      !fits(bound) || mesh.rest_weights.size() != mesh.morphs.size() || mesh.triangles.size() % 3 != 0)
    throw Broken();
  for (const std::uint32_t corner : mesh.triangles)
    if (corner >= points) throw Broken();
  return mesh;
}

void put_track(const Track& track, Writer& to) {
  to.put(track.node);
  to.put(track.property);
  if (const auto* turns = std::get_if<Curve<Quat>>(&track.curve)) {
    to.put('q');
    to.curve(*turns);
  } else {
    to.put('v');
    to.curve(std::get<Curve<Vec3>>(track.curve));
  }
}

Track track_from(Reader& from) {
  std::string node, property;
  from.get(node);
  from.get(property);
  char kind = 0;
  from.get(kind);
  if (kind == 'q') return {node, property, from.curve<Quat>()};
  return {node, property, from.curve<Vec3>()};
}

Model model_from(Reader& from) {
  Model model;
  from.expect(first_word);
  from.list(model.nodes, 96, [&](Node& node) {
    from.get(node.name);
    from.get(node.parent);
    from.get(node.rest.position);
    from.get(node.rest.rotation);
    from.get(node.rest.scale);
  });
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (model.nodes[i].parent != no_node && model.nodes[i].parent >= i) throw Broken();
  from.list(model.clips, 24, [&](Clip& clip) {
    from.get(clip.name);
    from.get(clip.duration);
    const std::size_t tracks = from.count(25);
    for (std::size_t i = 0; i < tracks; ++i) clip.tracks.push_back(track_from(from));
  });
  from.list(model.meshes, 64, [&](Mesh& mesh) { mesh = mesh_from(from); });
  from.list(model.skins, 16, [&](Skin& skin) {
    from.list(skin.joints);
    from.list(skin.inverse_binds, 96, [&](Skin::InverseBind& bind) {
      from.get(bind.linear);
      from.get(bind.translation);
    });
    if (skin.inverse_binds.size() != skin.joints.size()) throw Broken();
    for (const std::size_t joint : skin.joints)
      if (joint >= model.nodes.size()) throw Broken();
  });
  from.list(model.instances, 24, [&](MeshInstance& instance) {
    from.get(instance.node);
    from.get(instance.mesh);
    from.get(instance.skin);
    if (instance.node >= model.nodes.size() || instance.mesh >= model.meshes.size()) throw Broken();
    if (instance.skin == no_node) return;
    if (instance.skin >= model.skins.size()) throw Broken();
    const Influences& influences = model.meshes[instance.mesh].influences;
    for (std::size_t i = 0; i < influences.size(); ++i)
      for (const Influence& pull : influences[i])
        if (pull.joint >= model.skins[instance.skin].joints.size()) throw Broken();
  });
  from.list(model.repairs, 8, [&](std::string& repair) { from.get(repair); });
  from.expect(last_word);
  return model;
}

}  // namespace

std::string bytes_of(const Model& model) {
  Writer to;
  to.bytes = first_word;
  to.list(model.nodes, [&](const Node& node) {
    to.put(node.name);
    to.put(node.parent);
    to.put(node.rest.position);
    to.put(node.rest.rotation);
    to.put(node.rest.scale);
  });
  to.list(model.clips, [&](const Clip& clip) {
    to.put(clip.name);
    to.put(clip.duration);
    to.list(clip.tracks, [&](const Track& track) { put_track(track, to); });
  });
  to.list(model.meshes, [&](const Mesh& mesh) { put_mesh(mesh, to); });
  to.list(model.skins, [&](const Skin& skin) {
    to.list(skin.joints);
    to.list(skin.inverse_binds, [&](const Skin::InverseBind& bind) {
      to.put(bind.linear);
      to.put(bind.translation);
    });
  });
  to.list(model.instances, [&](const MeshInstance& instance) {
    to.put(instance.node);
    to.put(instance.mesh);
    to.put(instance.skin);
  });
  to.list(model.repairs);
  to.bytes += last_word;
  return std::move(to.bytes);
}

std::optional<Model> model_of(std::string_view bytes) {
  try {
    Reader from(bytes);
    return model_from(from);
  } catch (const Broken&) {
    return std::nullopt;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

}  // namespace tweenfall::assimp
