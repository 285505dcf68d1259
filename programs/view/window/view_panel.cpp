/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The panel of cgt-view; see view_panel.h. Controls come from the figure's table of options alone. Dear ImGui lays them
 * out at each event; SDL's software renderer draws what comes of it, so that no graphics card is needed. */
#include "view/window/view_panel.h"

#include <cfloat>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <imgui.h>

#include <cgt/figure.h>

#include "view/view_field.h"
#include "view/view_recent.h"

namespace
{

/* A row of the table, and what stands in its control. Values are lines, as viewer_copy_option has them. */
struct Field {
    cgt_figure_option row = {};
    uint32_t index = 0;
    const char *why_not = nullptr; /* it cannot change here */
    double start = 0.0;            /* of a slider where nothing is set */
    std::string values, refused;
    std::vector<std::string> lines; /* being edited; of an option that repeats with an empty one at the end */
    bool is_edited = false;         /* a control of it is in use, or holds what was refused */
    bool in_use = false;
    bool continues = false; /* a slider that has sent a value since it was taken */
    bool has_help = false;
};

const float outside = -1000.0f; /* of the pointer: a place, as a click counts only after a move */

const ImVec4 plain_text(0.93f, 0.93f, 0.93f, 1.0f), set_text(1.0f, 0.85f, 0.54f, 1.0f);
const ImVec4 error_text(1.0f, 0.66f, 0.62f, 1.0f), hint_text(0.72f, 0.72f, 0.72f, 1.0f);

} // namespace

struct view_panel {
    viewer *v = nullptr;
    ImGuiContext *context = nullptr;
    std::vector<Field> fields;
    std::vector<std::string> columns;
    std::string find, formula, selection; /* what is typed; how many spheres the formula selects */
    uint64_t version = UINT64_MAX;        /* of the options that are shown */
    bool has_focus = false;               /* the keyboard is the panel's */
    bool is_captured = false;             /* a button went down in it */
    bool wants_first = false;             /* the first control that the search finds is to have the keyboard */
    bool wants_find = false, is_outdated = true, closes = false;
    double time = 0.0;
    float scale = 0.0f;
    SDL_Surface *surface = nullptr;
    SDL_Renderer *renderer = nullptr;
    SDL_Texture *font = nullptr;
};

namespace
{

/* ---- Values ------------------------------------------------------------------------------------------------- */

std::vector<std::string> split(const char *text)
{
    std::vector<std::string> lines;
    for (const char *line = text; line && *line;) {
        const size_t length = strcspn(line, "\n");
        lines.emplace_back(line, length);
        line += length + (line[length] == '\n');
    }
    return lines;
}

std::vector<std::string> words_of(const view_panel &p, const Field &f)
{
    std::vector<std::string> words;
    for (const char *c = f.row.words; c && *c;) {
        const size_t length = strcspn(c, ", ");
        if (length)
            words.emplace_back(c, length);
        c += length + strspn(c + length, ", ");
    }
    const char *const value = f.row.value ? f.row.value : "";
    if (f.row.kind == CGT_FIGURE_FORMULA || strstr(value, "COLUMN") || strstr(value, "FORMULA") ||
        strcmp(value, "BY") == 0)
        words.insert(words.end(), p.columns.begin(), p.columns.end());
    return words;
}

void send(const view_panel &p, view_event_kind kind, const char *text, int key = 0, bool control = false)
{
    view_event e = {};
    e.kind = kind;
    e.key = key;
    e.control = control;
    e.text = text ? strdup(text) : nullptr;
    viewer_send(p.v, &e);
}

void put(const view_panel &p, Field &f, const std::string &lines, bool continues = false)
{
    view_event e = {};
    if (lines == f.values && f.refused.empty())
        return;
    e.kind = VIEW_PUT;
    e.option = f.index;
    e.text = strdup(lines.c_str());
    e.continues = continues;
    viewer_send(p.v, &e);
}

/* What stands in the fields of an option; is_on: where it is empty it is set without a value. */
std::string joined(const Field &f, bool is_on)
{
    std::string text;
    for (const std::string &line : f.lines) {
        const size_t from = line.find_first_not_of(" \t"), to = line.find_last_not_of(" \t");
        if (from != std::string::npos)
            text += line.substr(from, to - from + 1) + '\n';
    }
    return text.empty() && is_on ? "\n" : text;
}

void show_values(Field &f)
{
    f.lines = split(f.values.c_str());
    if (f.lines.empty() || (f.row.repeats && !f.lines.back().empty()))
        f.lines.emplace_back();
}

/* Takes what has changed over, but not into a control that is in use. */
void synchronize(view_panel &p)
{
    const uint64_t version = viewer_options_version(p.v);
    if (version == p.version)
        return;
    p.version = version;
    for (Field &f : p.fields) {
        char *values, *refused;
        viewer_copy_option(p.v, f.index, &values, &refused);
        const bool is_new = values && f.values != values;
        f.values = values ? values : "";
        f.refused = refused ? refused : "";
        if (!f.in_use && (is_new || f.refused.empty()))
            show_values(f);
        free(values);
        free(refused);
    }
    char *const columns = viewer_copy_columns(p.v);
    p.columns = split(columns);
    free(columns);
    char *const selection = viewer_copy_selection(p.v), *const formula = viewer_take_formula(p.v);
    p.selection = selection ? selection : "";
    if (formula)
        p.formula = formula;
    free(selection);
    free(formula);
    p.is_outdated = true;
}

/* ---- Controls ----------------------------------------------------------------------------------------------- */

int resize(ImGuiInputTextCallbackData *data)
{
    std::string *const text = static_cast<std::string *>(data->UserData);
    if (data->EventFlag == ImGuiInputTextFlags_CallbackResize) {
        text->resize(static_cast<size_t>(data->BufTextLen));
        data->Buf = &(*text)[0];
    }
    return 0;
}

bool input(const char *id, const char *hint, std::string &text, int flags = 0)
{
    return ImGui::InputTextWithHint(id, hint, &text[0], text.capacity() + 1, flags | ImGuiInputTextFlags_CallbackResize,
                                    resize, &text);
}

bool is_number(const Field &f) { return f.row.kind == CGT_FIGURE_NUMBER || f.row.kind == CGT_FIGURE_WHOLE; }

/* Ranges that a hand can find its way in. */
bool has_slider(const Field &f)
{
    return is_number(f) && (f.row.low >= 0.0 && f.row.high <= 1000.0 && f.row.high > f.row.low);
}

void finish(view_panel &p, Field &f, bool is_on)
{
    f.in_use |= ImGui::IsItemActive();
    if (ImGui::IsItemDeactivatedAfterEdit())
        put(p, f, joined(f, is_on));
}

void draw_switch(view_panel &p, Field &f)
{
    bool is_on = !f.values.empty();
    if (ImGui::Checkbox("##on", &is_on))
        put(p, f, !is_on ? "" : f.row.kind == CGT_FIGURE_SWITCH ? "\n" : joined(f, true));
}

void draw_words(view_panel &p, Field &f)
{
    const std::string now = f.values.empty() ? "default" : f.values.substr(0, f.values.find('\n'));
    if (!ImGui::BeginCombo("##word", now.c_str()))
        return;
    if (ImGui::Selectable("default", f.values.empty()))
        put(p, f, "");
    for (const std::string &word : words_of(p, f))
        if (ImGui::Selectable(word.c_str(), now == word))
            put(p, f, word + "\n");
    ImGui::EndCombo();
}

/* Offers values beside a field for any text. */
void draw_offers(view_panel &p, Field &f, const std::vector<std::string> &words)
{
    ImGui::SameLine(0.0f, 1.0f);
    if (!ImGui::BeginCombo("##offers", "", ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft))
        return;
    for (const std::string &word : words)
        if (ImGui::Selectable(word.c_str())) {
            f.lines.back() = word;
            put(p, f, joined(f, false));
        }
    ImGui::EndCombo();
}

void draw_slider(view_panel &p, Field &f, float width)
{
    const bool is_whole = f.row.kind == CGT_FIGURE_WHOLE;
    const double typed = f.lines[0].empty() ? f.start : atof(f.lines[0].c_str());
    const bool is_wide = f.row.low <= 0.1 && f.row.high >= 100.0;
    const int flags = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput |
                      (is_wide && !is_whole ? ImGuiSliderFlags_Logarithmic : 0);
    char text[32];
    float number = static_cast<float>(fmin(fmax(typed, f.row.low), f.row.high));
    int whole = static_cast<int>(number);
    ImGui::SetNextItemWidth(width);
    const bool moved =
        is_whole
            ? ImGui::SliderInt("##slider", &whole, static_cast<int>(f.row.low), static_cast<int>(f.row.high), "", flags)
            : ImGui::SliderFloat("##slider", &number, static_cast<float>(f.row.low), static_cast<float>(f.row.high), "",
                                 flags | ImGuiSliderFlags_NoRoundToFormat);
    if (ImGui::IsItemActivated())
        f.continues = false;
    f.in_use |= ImGui::IsItemActive();
    if (!moved)
        return;
    snprintf(text, sizeof text, is_whole ? "%.0f" : "%.4g",
             is_whole ? static_cast<double>(whole) : static_cast<double>(number));
    f.lines[0] = text;
    put(p, f, f.lines[0] + "\n", f.continues);
    f.continues = true;
}

void draw_color(view_panel &p, Field &f)
{
    uint8_t bytes[3] = {128, 128, 128};
    char text[16];
    view_field_color(f.lines[0].c_str(), bytes);
    float rgb[3] = {static_cast<float>(bytes[0]) / 255.0f, static_cast<float>(bytes[1]) / 255.0f,
                    static_cast<float>(bytes[2]) / 255.0f};
    ImGui::SameLine(0.0f, 1.0f);
    if (ImGui::ColorButton("##swatch", ImVec4(rgb[0], rgb[1], rgb[2], 1.0f),
                           ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop))
        ImGui::OpenPopup("picker");
    if (!ImGui::BeginPopup("picker"))
        return;
    const bool moved = ImGui::ColorPicker3("##picker", rgb,
                                           ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoInputs |
                                               ImGuiColorEditFlags_NoDragDrop | ImGuiColorEditFlags_NoOptions);
    if (ImGui::IsItemActivated())
        f.continues = false;
    f.in_use |= ImGui::IsItemActive();
    if (moved) {
        snprintf(text, sizeof text, "%02x%02x%02x", static_cast<unsigned>(lroundf(rgb[0] * 255.0f)),
                 static_cast<unsigned>(lroundf(rgb[1] * 255.0f)), static_cast<unsigned>(lroundf(rgb[2] * 255.0f)));
        f.lines[0] = text;
        put(p, f, f.lines[0] + "\n", f.continues);
        f.continues = true;
    }
    ImGui::EndPopup();
}

/* A field for each line; of numbers with a slider, of colours with a swatch. */
void draw_texts(view_panel &p, Field &f, float width)
{
    const std::vector<std::string> words = words_of(p, f);
    const float button = ImGui::GetFrameHeight() + 1.0f, left = ImGui::GetCursorPosX();
    const float beside = f.row.kind == CGT_FIGURE_COLOR || !words.empty() ? button : 0.0f;
    for (size_t i = 0; i < f.lines.size(); i++) {
        ImGui::PushID(static_cast<int>(i));
        ImGui::SetCursorPosX(left);
        ImGui::SetNextItemWidth(has_slider(f) ? 0.45f * width : width - beside);
        input("##text", i + 1 < f.lines.size() ? "" : f.row.value, f.lines[i]);
        finish(p, f, f.row.is_optional && !f.values.empty());
        ImGui::PopID();
    }
    if (has_slider(f)) {
        ImGui::SameLine(0.0f, 3.0f);
        draw_slider(p, f, width * 0.55f - 3.0f);
    } else if (f.row.kind == CGT_FIGURE_COLOR) {
        draw_color(p, f);
    } else if (!words.empty()) {
        draw_offers(p, f, words);
    }
}

/* ---- Rows --------------------------------------------------------------------------------------------------- */

void draw_wrapped(const char *text, const ImVec4 &color)
{
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextWrapped("%s", text);
    ImGui::PopStyleColor();
}

/* Name, control, what it is, and the way back. */
void draw_field(view_panel &p, Field &f)
{
    const float button = ImGui::GetFrameHeight() + 1.0f, whole = ImGui::GetContentRegionAvail().x;
    const float left = ImGui::GetCursorPosX(), control = floorf(0.34f * whole);
    float width = whole - control - 2.0f * button;
    ImGui::PushID(f.row.name);
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(f.values.empty() ? plain_text : set_text, "%s", f.row.name);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", f.row.name);
    ImGui::SameLine(left + control);
    f.in_use = false;
    ImGui::BeginGroup();
    if (p.wants_first)
        ImGui::SetKeyboardFocusHere();
    p.wants_first = false;
    if (f.why_not) {
        ImGui::PushTextWrapPos(left + control + width);
        ImGui::TextColored(hint_text, "%s", f.why_not);
        ImGui::PopTextWrapPos();
    } else {
        if (f.row.kind == CGT_FIGURE_SWITCH || f.row.is_optional) {
            draw_switch(p, f);
            ImGui::SameLine(0.0f, 3.0f);
            width -= button + 2.0f;
        }
        ImGui::SetNextItemWidth(width);
        if (f.row.kind == CGT_FIGURE_WORD)
            draw_words(p, f);
        else if (f.row.kind != CGT_FIGURE_SWITCH)
            draw_texts(p, f, width);
        else
            ImGui::NewLine();
    }
    ImGui::EndGroup();
    ImGui::SameLine(left + whole - 2.0f * button + 1.0f);
    if (ImGui::Button("?", ImVec2(button - 1.0f, 0.0f)))
        f.has_help = !f.has_help;
    if (!f.why_not && (!f.values.empty() || !f.refused.empty())) {
        ImGui::SameLine(left + whole - button + 1.0f);
        if (ImGui::Button("\xC3\x97", ImVec2(button - 1.0f, 0.0f))) { /* a multiplication sign */
            put(p, f, "");
            f.lines.assign(1, "");
        }
    }
    if (!f.refused.empty())
        draw_wrapped(f.refused.c_str(), error_text);
    if (f.has_help)
        draw_wrapped(f.row.help, hint_text);
    ImGui::PopID();
}

bool is_found(const view_panel &p, const Field &f)
{
    return p.find.empty() || strstr(f.row.name, p.find.c_str()) != nullptr;
}

/* A section for each heading of the table, of which those that people change most begin open. */
void draw_sections(view_panel &p)
{
    static const char *const opened[] = {"Colours and light:", "Style and light:", "What is drawn:"};
    for (size_t i = 0; i < p.fields.size();) {
        const char *const group = p.fields[i].row.group;
        size_t end = i, found = 0;
        for (; end < p.fields.size() && strcmp(p.fields[end].row.group, group) == 0; end++)
            found += is_found(p, p.fields[end]);
        bool is_open = false;
        for (const char *name : opened)
            is_open |= strcmp(name, group) == 0;
        if (found && !p.find.empty())
            ImGui::SetNextItemOpen(true);
        else
            ImGui::SetNextItemOpen(is_open, ImGuiCond_Once);
        const std::string title(group, strcspn(group, ":"));
        const bool shows = found && ImGui::CollapsingHeader(title.c_str());
        for (; i < end; i++)
            if (shows && is_found(p, p.fields[i]))
                draw_field(p, p.fields[i]);
            else
                p.fields[i].in_use = false;
    }
}

/* ---- The head ----------------------------------------------------------------------------------------------- */

/* Files that were opened last, by their names; where each lies is told beside it. */
void draw_recent(view_panel &p, float width)
{
    ImGui::SetNextItemWidth(width);
    if (!ImGui::BeginCombo("##recent", "Recent", ImGuiComboFlags_PopupAlignLeft | ImGuiComboFlags_NoArrowButton))
        return;
    char *const list = view_recent_list();
    for (const std::string &path : split(list)) {
        const size_t slash = path.rfind('/');
        ImGui::PushID(path.c_str());
        if (ImGui::Selectable(path.c_str() + slash + 1))
            send(p, VIEW_OPEN, (path + "\n").c_str());
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("%s", path.c_str());
        ImGui::PopID();
    }
    free(list);
    ImGui::EndCombo();
}

/* About the last control. */
void tell(const char *text)
{
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", text);
}

void draw_buttons(view_panel &p)
{
    static const struct {
        const char *name, *side;
    } looks[] = {{"Front", "front"}, {"Back", "back"}, {"Right", "right"},
                 {"Left", "left"},   {"Top", "top"},   {"Bottom", "bottom"}};
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - 3.0f * gap) / 4.0f;
    const ImVec2 size(width, 0.0f);
    if (ImGui::Button("Undo", size))
        send(p, VIEW_KEY, nullptr, 'u');
    ImGui::SameLine();
    if (ImGui::Button("Fit", size))
        send(p, VIEW_KEY, nullptr, 'f');
    ImGui::SameLine();
    if (ImGui::Button("Picture", size))
        send(p, VIEW_KEY, nullptr, 's');
    ImGui::SameLine();
    if (ImGui::Button("Close", size))
        p.closes = true;
    if (ImGui::Button("Movie", size))
        send(p, VIEW_KEY, nullptr, 'm');
    ImGui::SameLine();
    if (ImGui::Button("Command", size))
        send(p, VIEW_COPY, "command");
    tell("copies the command line of cgt-render that makes the picture");
    ImGui::SameLine();
    if (ImGui::Button("Python", size))
        send(p, VIEW_COPY, "python");
    tell("copies the lines of Python that make the picture");
    ImGui::SameLine();
    if (ImGui::Button("Camera", size))
        send(p, VIEW_KEY, nullptr, 'c');
    tell("copies the camera, as -c takes it");
    if (ImGui::Button("Open", size))
        send(p, VIEW_KEY, nullptr, 'o', true);
    ImGui::SameLine();
    draw_recent(p, width);
    ImGui::SameLine();
    if (ImGui::Button("Read anew", size))
        send(p, VIEW_KEY, nullptr, 'r');
    ImGui::SameLine();
    if (ImGui::Button("Save", size))
        send(p, VIEW_KEY, nullptr, 's', true);
    tell("the settings, as a file");
    const float third = (ImGui::GetContentRegionAvail().x - 5.0f * gap) / 6.0f;
    for (size_t i = 0; i < sizeof looks / sizeof looks[0]; i++) {
        if (i)
            ImGui::SameLine();
        if (ImGui::Button(looks[i].name, ImVec2(third, 0.0f)))
            send(p, VIEW_LOOK, looks[i].side);
    }
}

/* Spheres by a formula: how many they are, and what is done with them. */
void draw_selection(view_panel &p)
{
    static const struct {
        const char *name, *use, *told;
    } uses[] = {{"Hide", "hide", "adds the formula to hide"},
                {"Alone", "show", "adds the formula to show"},
                {"Fade", "fade", "the others are seen through: opacity"},
                {"Label", "label", "adds the formula to label"},
                {"Follow", "follow", "the camera goes with their middle from frame to frame, or no more"}};
    const float gap = ImGui::GetStyle().ItemSpacing.x, whole = ImGui::GetContentRegionAvail().x;
    const float button = ImGui::GetFrameHeight() + 1.0f;
    if (!ImGui::CollapsingHeader("Selection"))
        return;
    ImGui::SetNextItemWidth(0.75f * whole - button - gap);
    const bool is_typed = input("##formula", "formula, such as z > 5", p.formula);
    ImGui::SameLine(0.0f, 1.0f);
    bool is_chosen = false;
    if (ImGui::BeginCombo("##columns", "", ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft)) {
        for (const std::string &column : p.columns)
            if (ImGui::Selectable(column.c_str())) {
                p.formula = column;
                is_chosen = true;
            }
        ImGui::EndCombo();
    }
    if (is_typed || is_chosen)
        send(p, VIEW_SELECT, p.formula.c_str());
    ImGui::SameLine();
    if (ImGui::Button("Picked", ImVec2(-FLT_MIN, 0.0f)))
        send(p, VIEW_SELECT, nullptr);
    tell("the spheres that were clicked");
    if (!p.selection.empty())
        draw_wrapped(p.selection.c_str(), p.selection[0] >= '0' && p.selection[0] <= '9' ? plain_text : error_text);
    for (size_t i = 0; i < sizeof uses / sizeof uses[0]; i++) {
        if (i)
            ImGui::SameLine();
        if (ImGui::Button(uses[i].name, ImVec2((whole - 4.0f * gap) / 5.0f, 0.0f)))
            send(p, VIEW_USE, uses[i].use);
        tell(uses[i].told);
    }
}

void draw_all(view_panel &p)
{
    const ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;
    ImGui::SetNextWindowPos(ImVec2(0.0f, 0.0f));
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    ImGui::Begin("options", nullptr, flags);
    draw_buttons(p);
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (p.wants_find)
        ImGui::SetKeyboardFocusHere();
    p.wants_find = false;
    p.wants_first = input("##find", "find an option", p.find, ImGuiInputTextFlags_EnterReturnsTrue) && !p.find.empty();
    ImGui::BeginChild("sections", ImVec2(0.0f, 0.0f), false, ImGuiWindowFlags_NavFlattened);
    if (p.find.empty())
        draw_selection(p);
    draw_sections(p);
    ImGui::EndChild();
    ImGui::End();
}

/* One of Dear ImGui's frames: each event has one of its own, as its states of keys are those of a frame. */
void run_frame(view_panel &p)
{
    ImGuiIO &io = ImGui::GetIO();
    const double now = static_cast<double>(SDL_GetTicks64()) * 1e-3;
    io.DeltaTime = static_cast<float>(fmin(1.0, fmax(1e-3, now - p.time)));
    p.time = now;
    synchronize(p);
    ImGui::NewFrame();
    draw_all(p);
    ImGui::Render();
    p.is_outdated = true;
}

/* ---- Looks -------------------------------------------------------------------------------------------------- */

/* Text on each ground has a contrast of 4.5 or more (WCAG, AA). */
void set_colors(ImGuiStyle &style)
{
    static const struct {
        ImGuiCol which;
        float r, g, b;
    } colors[] = {{ImGuiCol_WindowBg, 0.11f, 0.12f, 0.13f},      {ImGuiCol_ChildBg, 0.11f, 0.12f, 0.13f},
                  {ImGuiCol_PopupBg, 0.09f, 0.10f, 0.11f},       {ImGuiCol_Border, 0.45f, 0.47f, 0.49f},
                  {ImGuiCol_FrameBg, 0.20f, 0.21f, 0.23f},       {ImGuiCol_FrameBgHovered, 0.25f, 0.27f, 0.30f},
                  {ImGuiCol_FrameBgActive, 0.25f, 0.27f, 0.30f}, {ImGuiCol_Button, 0.17f, 0.31f, 0.44f},
                  {ImGuiCol_ButtonHovered, 0.20f, 0.37f, 0.53f}, {ImGuiCol_ButtonActive, 0.20f, 0.37f, 0.53f},
                  {ImGuiCol_Header, 0.20f, 0.24f, 0.28f},        {ImGuiCol_HeaderHovered, 0.20f, 0.37f, 0.53f},
                  {ImGuiCol_HeaderActive, 0.20f, 0.37f, 0.53f},  {ImGuiCol_CheckMark, 1.0f, 0.85f, 0.54f},
                  {ImGuiCol_SliderGrab, 0.62f, 0.70f, 0.78f},    {ImGuiCol_SliderGrabActive, 1.0f, 0.85f, 0.54f},
                  {ImGuiCol_NavHighlight, 1.0f, 0.85f, 0.54f},   {ImGuiCol_TextSelectedBg, 0.20f, 0.37f, 0.53f},
                  {ImGuiCol_ScrollbarBg, 0.11f, 0.12f, 0.13f},   {ImGuiCol_ScrollbarGrab, 0.45f, 0.47f, 0.50f}};
    for (const auto &c : colors)
        style.Colors[c.which] = ImVec4(c.r, c.g, c.b, 1.0f);
    style.Colors[ImGuiCol_Text] = plain_text;
    style.Colors[ImGuiCol_TextDisabled] = hint_text;
}

void set_scale(view_panel &p, float scale)
{
    ImGuiIO &io = ImGui::GetIO();
    const char *const path = view_field_font();
    unsigned char *pixels;
    int width, height;
    p.scale = scale;
    ImGui::GetStyle() = ImGuiStyle();
    ImGui::GetStyle().AntiAliasedLines = false; /* thin ones are too faint as triangles */
    ImGui::GetStyle().WindowBorderSize = 0.0f;
    ImGui::GetStyle().FrameBorderSize = 1.0f; /* the ground of a field is too near to that of the panel */
    ImGui::GetStyle().ItemSpacing = ImVec2(4.0f, 4.0f);
    ImGui::GetStyle().FrameRounding = 0.0f;
    ImGui::GetStyle().ScaleAllSizes(scale);
    set_colors(ImGui::GetStyle());
    io.Fonts->Clear();
    ImFontConfig config;
    config.OversampleH = 1;
    config.PixelSnapH = true;
    if (!path || !io.Fonts->AddFontFromFileTTF(path, floorf(14.0f * scale + 0.5f), &config))
        io.Fonts->AddFontDefault();
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    if (p.font)
        SDL_DestroyTexture(p.font);
    SDL_Surface *const from =
        SDL_CreateRGBSurfaceWithFormatFrom(pixels, width, height, 32, 4 * width, SDL_PIXELFORMAT_RGBA32);
    p.font = from ? SDL_CreateTextureFromSurface(p.renderer, from) : nullptr;
    SDL_FreeSurface(from);
    if (p.font)
        SDL_SetTextureBlendMode(p.font, SDL_BLENDMODE_BLEND);
}

/* Triangles of lists of commands, each cut to a rectangle. */
void render(view_panel &p)
{
    const ImDrawData *const data = ImGui::GetDrawData();
    for (int n = 0; n < data->CmdListsCount; n++) {
        const ImDrawList *const list = data->CmdLists[n];
        for (const ImDrawCmd &c : list->CmdBuffer) {
            const SDL_Rect clip = {static_cast<int>(c.ClipRect.x), static_cast<int>(c.ClipRect.y),
                                   static_cast<int>(c.ClipRect.z - c.ClipRect.x),
                                   static_cast<int>(c.ClipRect.w - c.ClipRect.y)};
            const ImDrawVert *const first = list->VtxBuffer.Data + c.VtxOffset;
            if (clip.w <= 0 || clip.h <= 0)
                continue;
            SDL_RenderSetClipRect(p.renderer, &clip);
            SDL_RenderGeometryRaw(p.renderer, p.font, &first->pos.x, sizeof *first,
                                  reinterpret_cast<const SDL_Color *>(&first->col), sizeof *first, &first->uv.x,
                                  sizeof *first, list->VtxBuffer.Size - static_cast<int>(c.VtxOffset),
                                  list->IdxBuffer.Data + c.IdxOffset, static_cast<int>(c.ElemCount), sizeof(ImDrawIdx));
        }
    }
    SDL_RenderSetClipRect(p.renderer, nullptr);
    SDL_RenderFlush(p.renderer);
}

/* ---- Events ------------------------------------------------------------------------------------------------- */

const struct {
    SDL_Keycode from;
    ImGuiKey to;
} keys[] = {{SDLK_TAB, ImGuiKey_Tab},
            {SDLK_LEFT, ImGuiKey_LeftArrow},
            {SDLK_RIGHT, ImGuiKey_RightArrow},
            {SDLK_UP, ImGuiKey_UpArrow},
            {SDLK_DOWN, ImGuiKey_DownArrow},
            {SDLK_PAGEUP, ImGuiKey_PageUp},
            {SDLK_PAGEDOWN, ImGuiKey_PageDown},
            {SDLK_HOME, ImGuiKey_Home},
            {SDLK_END, ImGuiKey_End},
            {SDLK_DELETE, ImGuiKey_Delete},
            {SDLK_BACKSPACE, ImGuiKey_Backspace},
            {SDLK_SPACE, ImGuiKey_Space},
            {SDLK_RETURN, ImGuiKey_Enter},
            {SDLK_KP_ENTER, ImGuiKey_KeyPadEnter},
            {SDLK_ESCAPE, ImGuiKey_Escape},
            {SDLK_a, ImGuiKey_A}, /* with Ctrl, in texts */
            {SDLK_c, ImGuiKey_C},
            {SDLK_v, ImGuiKey_V},
            {SDLK_x, ImGuiKey_X},
            {SDLK_y, ImGuiKey_Y},
            {SDLK_z, ImGuiKey_Z}};

void set_key(ImGuiIO &io, ImGuiKey key, bool is_down)
{
#if IMGUI_VERSION_NUM >= 18700
    io.AddKeyEvent(key, is_down);
#else
    io.KeysDown[key] = is_down;
#endif
}

void set_modifiers(ImGuiIO &io, unsigned modifiers)
{
    const bool shift = (modifiers & KMOD_SHIFT) != 0, control = (modifiers & KMOD_CTRL) != 0;
#if IMGUI_VERSION_NUM >= 18900
    io.AddKeyEvent(ImGuiMod_Shift, shift);
    io.AddKeyEvent(ImGuiMod_Ctrl, control);
#elif IMGUI_VERSION_NUM >= 18700
    io.AddKeyEvent(ImGuiKey_ModShift, shift);
    io.AddKeyEvent(ImGuiKey_ModCtrl, control);
#else
    io.KeyShift = shift;
    io.KeyCtrl = control;
#endif
}

void set_pointer(ImGuiIO &io, float x, float y)
{
#if IMGUI_VERSION_NUM >= 18700
    io.AddMousePosEvent(x, y);
#else
    io.MousePos = ImVec2(x, y);
#endif
}

void set_button(ImGuiIO &io, int button, bool is_down)
{
#if IMGUI_VERSION_NUM >= 18700
    io.AddMouseButtonEvent(button, is_down);
#else
    io.MouseDown[button] = is_down;
#endif
}

void add_wheel(ImGuiIO &io, float turns)
{
#if IMGUI_VERSION_NUM >= 18700
    io.AddMouseWheelEvent(0.0f, turns);
#else
    io.MouseWheel += turns;
#endif
}

/* Texts have all keys; else the panel has those that go from control to control, and Escape closes it. */
int take_key(view_panel &p, const SDL_KeyboardEvent &e)
{
    ImGuiIO &io = ImGui::GetIO();
    const bool is_text = io.WantTextInput;
    const bool is_down = e.type == SDL_KEYDOWN;
    if (!p.has_focus)
        return VIEW_PANEL_LEAVES;
    set_modifiers(io, e.keysym.mod);
    for (const auto &key : keys) {
        const bool is_letter = key.from < 128 && key.from >= 'a';
        if (key.from != e.keysym.sym || (is_letter && !is_text && is_down))
            continue;
        if (key.to == ImGuiKey_Escape && is_down && !is_text && !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup))
            return VIEW_PANEL_CLOSES;
        if (is_down && e.repeat) {
            set_key(io, key.to, false);
            run_frame(p);
        }
        set_key(io, key.to, is_down);
        run_frame(p);
        return VIEW_PANEL_TAKES;
    }
    return is_text ? VIEW_PANEL_TAKES : VIEW_PANEL_LEAVES;
}

int take_button(view_panel &p, const SDL_MouseButtonEvent &e, float x, float y, bool is_inside)
{
    const int button = e.button == SDL_BUTTON_LEFT ? 0 : e.button == SDL_BUTTON_RIGHT ? 1 : 2;
    if (e.type == SDL_MOUSEBUTTONDOWN)
        p.has_focus = p.is_captured = is_inside;
    const bool is_taken = p.is_captured;
    if (e.type == SDL_MOUSEBUTTONUP)
        p.is_captured = false;
    if (!is_taken)
        return VIEW_PANEL_LEAVES;
    for (int i = 1; i >= 0; i--) { /* after keys the pointer counts once it has moved, and a click once it is there */
        set_pointer(ImGui::GetIO(), x, y + static_cast<float>(i));
        run_frame(p);
    }
    set_button(ImGui::GetIO(), button, e.type == SDL_MOUSEBUTTONDOWN);
    run_frame(p);
    return VIEW_PANEL_TAKES;
}

} // namespace

view_panel *view_panel_create(viewer *v)
{
    view_panel *const p = new view_panel;
    cgt_figure_option row;
    p->v = v;
    for (uint32_t i = 0; cgt_figure_get_option(i, &row); i++) {
        Field f;
        f.row = row;
        f.index = i;
        f.why_not = view_field_why_not(row.name);
        f.start = view_field_start(row.name);
        f.lines.emplace_back();
        p->fields.push_back(f);
    }
    p->context = ImGui::CreateContext();
    ImGuiIO &io = ImGui::GetIO();
    io.IniFilename = io.LogFilename = nullptr;
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.ConfigInputTextCursorBlink = false;
    set_pointer(io, outside, outside);
    io.SetClipboardTextFn = [](void *, const char *text) { SDL_SetClipboardText(text); };
    io.GetClipboardTextFn = [](void *) -> const char * {
        static std::string kept;
        char *const text = SDL_GetClipboardText();
        kept = text ? text : "";
        SDL_free(text);
        return kept.c_str();
    };
#if IMGUI_VERSION_NUM < 18700
    for (const auto &key : keys)
        io.KeyMap[key.to] = key.to;
#endif
    return p;
}

void view_panel_free(view_panel *p)
{
    if (!p)
        return;
    if (p->font)
        SDL_DestroyTexture(p->font);
    if (p->renderer)
        SDL_DestroyRenderer(p->renderer);
    SDL_FreeSurface(p->surface);
    ImGui::DestroyContext(p->context);
    delete p;
}

void view_panel_focus(view_panel *p) { p->has_focus = p->wants_find = p->is_outdated = true; }

int view_panel_event(view_panel *p, const SDL_Event *e, float left, float pixels)
{
    ImGuiIO &io = ImGui::GetIO();
    const bool is_button = e->type == SDL_MOUSEBUTTONDOWN || e->type == SDL_MOUSEBUTTONUP;
    int result = VIEW_PANEL_LEAVES;
    if (!p->font) /* not yet drawn */
        return VIEW_PANEL_LEAVES;
    if (is_button || e->type == SDL_MOUSEMOTION || e->type == SDL_MOUSEWHEEL) {
        const int x = is_button ? e->button.x : e->type == SDL_MOUSEWHEEL ? e->wheel.mouseX : e->motion.x;
        const int y = is_button ? e->button.y : e->type == SDL_MOUSEWHEEL ? e->wheel.mouseY : e->motion.y;
        const float at = static_cast<float>(x) * pixels - left;
        const bool is_inside = at >= 0.0f;
        if (is_inside || p->is_captured)
            set_pointer(io, at, static_cast<float>(y) * pixels);
        else
            set_pointer(io, outside, outside);
        if (is_button) {
            result = take_button(*p, e->button, at, static_cast<float>(y) * pixels, is_inside);
        } else if (is_inside || p->is_captured) {
            if (e->type == SDL_MOUSEWHEEL)
                add_wheel(io, e->wheel.preciseY);
            run_frame(*p);
            result = VIEW_PANEL_TAKES;
        }
    } else if (e->type == SDL_KEYDOWN || e->type == SDL_KEYUP) {
        result = take_key(*p, e->key);
    } else if (e->type == SDL_TEXTINPUT && p->has_focus) {
        set_modifiers(io, KMOD_NONE);
        io.AddInputCharactersUTF8(e->text.text);
        run_frame(*p);
        result = VIEW_PANEL_TAKES;
    }
    if (p->closes)
        result = VIEW_PANEL_CLOSES;
    p->closes = false;
    return result;
}

SDL_Surface *view_panel_draw(view_panel *p, int width, int height, float scale, int all)
{
    ImGuiIO &io = ImGui::GetIO();
    if (!p->surface || p->surface->w != width || p->surface->h != height) {
        if (p->font)
            SDL_DestroyTexture(p->font);
        if (p->renderer)
            SDL_DestroyRenderer(p->renderer);
        SDL_FreeSurface(p->surface);
        p->font = nullptr;
        p->surface = SDL_CreateRGBSurfaceWithFormat(0, width, height, 32, SDL_PIXELFORMAT_RGB888);
        p->renderer = p->surface ? SDL_CreateSoftwareRenderer(p->surface) : nullptr;
        p->scale = 0.0f;
        if (!p->renderer)
            return nullptr;
    }
    if (scale != p->scale)
        set_scale(*p, scale);
    io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
    synchronize(*p);
    if (!p->is_outdated && !all)
        return nullptr;
    for (int i = 0; i < 3; i++) /* sizes follow from the frame before */
        run_frame(*p);
    SDL_SetRenderDrawColor(p->renderer, 28, 31, 33, 255);
    SDL_RenderClear(p->renderer);
    render(*p);
    p->is_outdated = false;
    return p->surface;
}
