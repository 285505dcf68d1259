/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The module cgt-gltf; see gltf_module.h. tinygltf drops some of what it cannot parse and notes it: here each note is
 * an error. No exception leaves this file. */
#include "mesh/gltf/gltf_module.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream> /* tiny_gltf.h writes files, too, and includes it only for reading */
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/stat.h>

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

namespace
{

/* ---- The document -------------------------------------------------------------------------------------------- */

constexpr std::size_t glb_header = 12, chunk_header = 8;

std::uint32_t u32_at(const unsigned char *b)
{
    return b[0] | b[1] << 8 | b[2] << 16 | static_cast<std::uint32_t>(b[3]) << 24;
}

void put_u32(std::string &to, std::size_t value)
{
    for (int i = 0; i < 4; i++)
        to += static_cast<char>(value >> (8 * i) & 255);
}

/* tinygltf takes 12.0 for no whole number, and the member for absent. */
void make_whole(nlohmann::json &value)
{
    if (value.is_structured()) {
        for (auto &member : value)
            make_whole(member);
    } else if (value.is_number_float()) {
        const double number = value.get<double>();
        if (number == std::floor(number) && std::fabs(number) < 9e15 && !(number == 0.0 && std::signbit(number)))
            value = static_cast<std::int64_t>(number);
        if (value.is_number_integer() && value.get<std::int64_t>() >= 0)
            value = static_cast<std::uint64_t>(number);
    }
}

/* Members that may be absent, but not for tinygltf: a skin's matrices, and the node of a channel, which moves something
 * else then. */
void set_absent(nlohmann::json &document)
{
    const nlohmann::json none = nlohmann::json::array();
    const auto list = [&](nlohmann::json &of, const char *name) -> nlohmann::json {
        return of.is_object() && of.contains(name) && of[name].is_array() ? of[name] : none;
    };
    nlohmann::json skins = list(document, "skins"), clips = list(document, "animations");
    for (auto &skin : skins)
        if (skin.is_object() && !skin.contains("inverseBindMatrices"))
            skin["inverseBindMatrices"] = GLTF_NONE;
    for (auto &clip : clips) {
        nlohmann::json channels = list(clip, "channels");
        for (auto &channel : channels)
            if (channel.is_object() && channel.contains("target") && channel["target"].is_object() &&
                !channel["target"].contains("node"))
                channel["target"]["node"] = GLTF_NONE;
        if (clip.is_object() && clip.contains("channels"))
            clip["channels"] = channels;
    }
    if (!skins.empty())
        document["skins"] = skins;
    if (!clips.empty())
        document["animations"] = clips;
}

/* The document as text without what changes no triangle: pictures need not exist. */
std::string reduce(const char *begin, const char *end)
{
    nlohmann::json document = nlohmann::json::parse(begin, end);
    if (!document.is_object())
        throw std::runtime_error("the document is no JSON object");
    for (const char *const name : {"images", "textures", "materials", "samplers", "cameras", "extras", "extensions"})
        document.erase(name);
    make_whole(document);
    set_absent(document);
    return document.dump();
}

/* tinygltf also asks for names under the working folder. A file names only what lies beside it: no path from the root,
 * no parent folder. */
bool is_beside(const std::string &path, const std::string &folder)
{
    const std::string base = folder.empty() || folder.back() == '/' ? folder : folder + "/";
    if (path.compare(0, base.size(), base) != 0)
        return false;
    const std::string rest = "/" + path.substr(base.size()) + "/";
    return rest.compare(0, 2, "//") != 0 && rest.find("/../") == std::string::npos;
}

bool file_exists(const std::string &path, void *folder)
{
    struct stat status;
    if (!is_beside(path, *static_cast<const std::string *>(folder)))
        return false;
    return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

std::string expand_path(const std::string &path, void *) { return path; }

bool read_file(std::vector<unsigned char> *bytes, std::string *error, const std::string &path, void *)
{
    const std::unique_ptr<std::FILE, int (*)(std::FILE *)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    unsigned char block[65536];
    std::size_t got = 0;
    while (file && (got = std::fread(block, 1, sizeof block, file.get())) > 0)
        bytes->insert(bytes->end(), block, block + got);
    if (file && !std::ferror(file.get()))
        return true;
    *error = "cannot be read";
    return false;
}

bool write_file(std::string *, const std::string &, const std::vector<unsigned char> &, void *) { return false; }

void parse(tinygltf::Model &model, const unsigned char *bytes, std::size_t size, const std::string &folder)
{
    const char *const text = reinterpret_cast<const char *>(bytes);
    if (size > std::numeric_limits<unsigned>::max() / 2)
        throw std::runtime_error("files of 2 GiB and more cannot be read");
    tinygltf::TinyGLTF loader;
    std::string base = folder;
    loader.SetFsCallbacks({file_exists, expand_path, read_file, write_file, &base});
    std::string error, warning;
    bool whole = false;
    if (size >= 4 && std::memcmp(bytes, "glTF", 4) == 0) {
        if (size < glb_header + chunk_header || u32_at(bytes + 8) > size)
            throw std::runtime_error("the file is cut off");
        const std::size_t length = u32_at(bytes + glb_header), data = glb_header + chunk_header + length;
        if (length > size - glb_header - chunk_header || std::memcmp(bytes + glb_header + 4, "JSON", 4) != 0)
            throw std::runtime_error("the file does not begin with its document");
        std::string document = reduce(text + glb_header + chunk_header, text + data);
        document.resize((document.size() + 3) / 4 * 4, ' ');
        std::string binary("glTF");
        put_u32(binary, 2);
        put_u32(binary, glb_header + chunk_header + document.size() + (size - data));
        put_u32(binary, document.size());
        binary += "JSON" + document;
        binary.append(text + data, size - data);
        whole = loader.LoadBinaryFromMemory(&model, &error, &warning,
                                            reinterpret_cast<const unsigned char *>(binary.data()),
                                            static_cast<unsigned>(binary.size()), folder);
    } else {
        const std::string document = reduce(text, text + size);
        whole = loader.LoadASCIIFromString(&model, &error, &warning, document.data(),
                                           static_cast<unsigned>(document.size()), folder);
    }
    if (!whole || !error.empty())
        throw std::runtime_error(error.empty() ? "the file cannot be parsed" : error);
}

/* ---- As plain arrays ----------------------------------------------------------------------------------------- */

struct flat_file : gltf_file { /* the arrays of the file that it is */
    tinygltf::Model model;
    std::vector<int> number;
    std::vector<double> real;
    std::vector<gltf_view> view;
    std::vector<gltf_accessor> accessor;
    std::vector<gltf_primitive> primitive;
    std::vector<gltf_mesh> mesh;
    std::vector<gltf_node> node;
    std::vector<gltf_skin> skin;
    std::vector<gltf_channel> channel;
    std::vector<gltf_clip> clip;
    std::vector<const char *> required;
    flat_file() : gltf_file() {}
};

gltf_list add(std::vector<int> &to, const std::vector<int> &from)
{
    to.insert(to.end(), from.begin(), from.end());
    return {to.size() - from.size(), from.size()};
}

gltf_list add(std::vector<double> &to, const std::vector<double> &from)
{
    to.insert(to.end(), from.begin(), from.end());
    return {to.size() - from.size(), from.size()};
}

int find(const std::map<std::string, int> &attributes, const std::string &name)
{
    const auto found = attributes.find(name);
    return found == attributes.end() ? GLTF_NONE : found->second;
}

void add_views(flat_file &f)
{
    for (const tinygltf::BufferView &v : f.model.bufferViews) {
        gltf_view view = {nullptr, v.byteLength, v.byteStride, 0};
        for (const char *const name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
            view.is_compressed |= v.extensions.count(name) > 0;
        if (v.buffer >= 0 && static_cast<std::size_t>(v.buffer) < f.model.buffers.size()) {
            const tinygltf::Buffer &buffer = f.model.buffers[static_cast<std::size_t>(v.buffer)];
            /* in a binary file the first buffer alone is the one behind the document */
            const bool has_data = v.buffer == 0 || !buffer.uri.empty();
            if (has_data && v.byteOffset <= buffer.data.size() && v.byteLength <= buffer.data.size() - v.byteOffset)
                view.bytes = buffer.data.data() + v.byteOffset;
        }
        f.view.push_back(view);
    }
}

void add_accessors(flat_file &f)
{
    for (const tinygltf::Accessor &a : f.model.accessors) {
        gltf_accessor out = {};
        out.view = a.bufferView;
        out.offset = a.byteOffset;
        out.count = a.count;
        out.component = a.componentType;
        out.components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type));
        out.is_matrix = a.type == TINYGLTF_TYPE_MAT2 || a.type == TINYGLTF_TYPE_MAT3 || a.type == TINYGLTF_TYPE_MAT4;
        out.is_normalized = a.normalized;
        out.is_sparse = a.sparse.isSparse;
        if (a.sparse.isSparse) {
            out.replaced = a.sparse.count;
            out.index_view = a.sparse.indices.bufferView;
            out.index_offset = a.sparse.indices.byteOffset;
            out.index_component = a.sparse.indices.componentType;
            out.value_view = a.sparse.values.bufferView;
            out.value_offset = a.sparse.values.byteOffset;
        }
        f.accessor.push_back(out);
    }
}

void add_primitive(flat_file &f, const tinygltf::Primitive &p)
{
    gltf_primitive out = {};
    out.mode = p.mode;
    out.indices = p.indices;
    out.position = find(p.attributes, "POSITION");
    out.normal = find(p.attributes, "NORMAL");
    for (int i = 0; i < GLTF_JOINT_SETS; i++) {
        out.joints[i] = find(p.attributes, "JOINTS_" + std::to_string(i));
        out.weights[i] = find(p.attributes, "WEIGHTS_" + std::to_string(i));
    }
    out.more_joints = find(p.attributes, "JOINTS_" + std::to_string(GLTF_JOINT_SETS)) != GLTF_NONE;
    out.is_draco = p.extensions.count("KHR_draco_mesh_compression") > 0;
    std::vector<int> positions, normals;
    for (const auto &target : p.targets) {
        positions.push_back(find(target, "POSITION"));
        normals.push_back(find(target, "NORMAL"));
    }
    out.target_positions = add(f.number, positions);
    out.target_normals = add(f.number, normals);
    f.primitive.push_back(out);
}

void add_meshes(flat_file &f)
{
    for (const tinygltf::Mesh &m : f.model.meshes) {
        f.mesh.push_back({{f.primitive.size(), m.primitives.size()}, add(f.real, m.weights)});
        for (const tinygltf::Primitive &p : m.primitives)
            add_primitive(f, p);
    }
}

/* A list of the document whose length is given, or the default. */
void copy(double *to, const std::vector<double> &from, std::vector<double> standard, const char *name)
{
    if (!from.empty() && from.size() != standard.size())
        throw std::runtime_error(std::string("a node's ") + name + " has " + std::to_string(from.size()) + " numbers");
    const std::vector<double> &values = from.empty() ? standard : from;
    std::copy(values.begin(), values.end(), to);
}

int instance_accessor(const tinygltf::Value &attributes, const char *name)
{
    const bool has = attributes.IsObject() && attributes.Has(name) && attributes.Get(name).IsNumber();
    return has ? attributes.Get(name).GetNumberAsInt() : GLTF_NONE;
}

void add_nodes(flat_file &f)
{
    for (const tinygltf::Node &n : f.model.nodes) {
        gltf_node out = {};
        out.mesh = n.mesh;
        out.skin = n.skin;
        out.children = add(f.number, n.children);
        out.weights = add(f.real, n.weights);
        out.has_matrix = !n.matrix.empty();
        copy(out.matrix, n.matrix, std::vector<double>(16), "matrix");
        copy(out.translation, n.translation, {0, 0, 0}, "translation");
        copy(out.rotation, n.rotation, {0, 0, 0, 1}, "rotation");
        copy(out.scale, n.scale, {1, 1, 1}, "scale");
        const auto instancing = n.extensions.find("EXT_mesh_gpu_instancing");
        out.is_instanced = instancing != n.extensions.end();
        if (out.is_instanced) {
            const tinygltf::Value &extension = instancing->second;
            const tinygltf::Value none, &attributes = extension.IsObject() ? extension.Get("attributes") : none;
            out.instance_translation = instance_accessor(attributes, "TRANSLATION");
            out.instance_rotation = instance_accessor(attributes, "ROTATION");
            out.instance_scale = instance_accessor(attributes, "SCALE");
        }
        f.node.push_back(out);
    }
    for (const tinygltf::Skin &s : f.model.skins)
        f.skin.push_back({add(f.number, s.joints), s.inverseBindMatrices});
}

gltf_channel make_channel(const tinygltf::Animation &a, const tinygltf::AnimationChannel &c)
{
    static const char *const paths[] = {"translation", "rotation", "scale", "weights"};
    static const char *const interpolations[] = {"LINEAR", "STEP", "CUBICSPLINE"};
    gltf_channel out = {c.target_node, GLTF_NONE, GLTF_NONE, GLTF_OTHER, GLTF_UNKNOWN};
    for (int i = 0; i < 4; i++)
        out.path = c.target_path == paths[i] ? static_cast<gltf_path>(i) : out.path;
    if (c.sampler >= 0 && static_cast<std::size_t>(c.sampler) < a.samplers.size()) {
        const tinygltf::AnimationSampler &sampler = a.samplers[static_cast<std::size_t>(c.sampler)];
        out.input = sampler.input;
        out.output = sampler.output;
        for (int i = 0; i < 3; i++)
            out.interpolation =
                sampler.interpolation == interpolations[i] ? static_cast<gltf_interpolation>(i) : out.interpolation;
    }
    return out;
}

void add_clips(flat_file &f)
{
    for (const tinygltf::Animation &a : f.model.animations) {
        f.clip.push_back({a.name.c_str(), {f.channel.size(), a.channels.size()}});
        for (const tinygltf::AnimationChannel &c : a.channels)
            f.channel.push_back(make_channel(a, c));
    }
}

void add_scene(flat_file &f)
{
    const std::size_t scene = f.model.defaultScene < 0 ? 0 : static_cast<std::size_t>(f.model.defaultScene);
    f.has_scene = scene < f.model.scenes.size();
    if (f.has_scene)
        f.roots = add(f.number, f.model.scenes[scene].nodes);
    for (const std::string &name : f.model.extensionsRequired)
        f.required.push_back(name.c_str());
}

void finish(flat_file &f)
{
    gltf_file &out = f;
    out.number = f.number.data(), out.real = f.real.data();
    for (const tinygltf::Buffer &buffer : f.model.buffers)
        out.bytes += buffer.data.size();
    out.view = f.view.data(), out.views = f.view.size();
    out.accessor = f.accessor.data(), out.accessors = f.accessor.size();
    out.primitive = f.primitive.data(), out.primitives = f.primitive.size();
    out.mesh = f.mesh.data(), out.meshes = f.mesh.size();
    out.node = f.node.data(), out.nodes = f.node.size();
    out.skin = f.skin.data(), out.skins = f.skin.size();
    out.channel = f.channel.data(), out.channels = f.channel.size();
    out.clip = f.clip.data(), out.clips = f.clip.size();
    out.required = f.required.data(), out.extensions_required = f.required.size();
}

} // namespace

extern "C" gltf_file *cgt_gltf_load(const unsigned char *bytes, size_t size, const char *folder, char *error,
                                    size_t error_size)
{
    try {
        std::unique_ptr<flat_file> f(new flat_file);
        parse(f->model, bytes, size, folder);
        add_views(*f);
        add_accessors(*f);
        add_meshes(*f);
        add_nodes(*f);
        add_clips(*f);
        add_scene(*f);
        finish(*f);
        return f.release();
    } catch (const std::exception &failure) {
        std::snprintf(error, error_size, "%s", failure.what());
    } catch (...) {
        std::snprintf(error, error_size, "tinygltf failed");
    }
    return nullptr;
}

extern "C" void cgt_gltf_free(gltf_file *file) { delete static_cast<flat_file *>(file); }
