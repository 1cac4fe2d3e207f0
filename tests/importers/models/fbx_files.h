#pragma once

// Small FBX files put together for tests, in the text form.

#include "importers/models/model_support.h"

#include <initializer_list>
#include <sstream>

namespace tweenfall::test {

/// A scene being assembled: objects and connections, with their own numbers.
class FbxText {
 public:
  int model(const std::string& name, const std::string& properties, int parent = 0) {
    return object("Model", "Model::" + name, "Mesh", "Properties70: { " + properties + " }", parent);
  }

  /// Adds an object that hangs on another. @returns its number.
  int object(const std::string& kind, const std::string& name, const std::string& form, const std::string& content,
             int above = -1) {
    const int id = ++last_;
    objects_ << kind << ": " << id << ", \"" << name << "\", \"" << form << "\" {\n" << content << "\n}\n";
    if (above >= 0) connect(id, above);
    return id;
  }

  void connect(int from, int to, const std::string& property = "") {
    if (property.empty())
      connections_ << "C: \"OO\"," << from << "," << to << "\n";
    else
      connections_ << "C: \"OP\"," << from << "," << to << ", \"" << property << "\"\n";
  }

  int stack(double seconds) {
    return object("AnimationStack", "AnimStack::move", "",
                  "Properties70: { P: \"LocalStop\", \"KTime\", \"Time\", \"\"," + ticks(seconds) + " }");
  }
  int layer(int stack, const std::string& properties = "") {
    return object("AnimationLayer", "AnimLayer::layer", "", "Properties70: { " + properties + " }", stack);
  }

  /// A curve for one part of a property. @param flags, data  one for all keys: as the file states them
  int curve(int layer, int target, const std::string& property, const std::string& part,
            const std::vector<std::pair<double, double>>& keys, unsigned flags,
            const std::string& data = "0,0,218434821,0", const std::string& more = "") {
    const int node = object("AnimationCurveNode", "AnimCurveNode::N", "", "", layer);
    connect(node, target, property);
    std::string times, values;
    for (const auto& [time, value] : keys) {
      times += (times.empty() ? "" : ",") + ticks(time);
      values += (values.empty() ? "" : ",") + number(value);
    }
    const std::string count = std::to_string(keys.size());
    const int made =
        object("AnimationCurve", "AnimCurve::", "",
               "KeyTime: *" + count + " { a: " + times + " }\nKeyValueFloat: *" + count + " { a: " + values +
                   " }\nKeyAttrFlags: *1 { a: " + std::to_string(flags) + " }\nKeyAttrDataFloat: *4 { a: " + data +
                   " }\nKeyAttrRefCount: *1 { a: " + count + " }\n" + more);
    connect(made, node, part);
    return node;
  }

  [[nodiscard]] std::string text() const {
    return "; FBX 7.5.0 project file\nFBXHeaderExtension: {\nFBXHeaderVersion: 1003\nFBXVersion: 7500\n}\nObjects: "
           "{\n" +
           objects_.str() + "}\nConnections: {\n" + connections_.str() + "}\n";
  }

  static std::string vector(const std::string& name, const Vec3& v) {
    return "P: \"" + name + "\", \"Vector3D\", \"Vector\", \"\"," + number(v[0]) + "," + number(v[1]) + "," +
           number(v[2]) + "\n";
  }
  static std::string whole(const std::string& name, int value) {
    return "P: \"" + name + "\", \"enum\", \"\", \"\"," + std::to_string(value) + "\n";
  }
  static std::string number(double value) {
    std::ostringstream out;
    out.precision(17);
    out << value;
    return out.str();
  }
  static std::string ticks(double seconds) {
    return std::to_string(static_cast<long long>(std::llround(seconds * 46186158000.0)));
  }

 private:
  std::ostringstream objects_, connections_;
  int last_ = 100;
};

/// The bits of a float as the number that a text file states.
inline std::string float_bits(float value) {
  std::int32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return std::to_string(bits);
}

}  // namespace tweenfall::test
