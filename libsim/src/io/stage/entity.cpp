// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/entity.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <utility>

#include "io/document.h"
#include "io/stage/report.h"
#include "sim/core/file.h"

namespace sim::io::stage {
namespace {

namespace fs = std::filesystem;

// Limits far beyond any real world, so that a small file cannot take all memory.
constexpr int kMaxNesting = 32;
constexpr int kMaxIncludes = 32;
constexpr std::size_t kMaxItems = 500'000;

/// A property or an entity as written, before definitions are resolved.
struct Item {
  bool is_entity = false;
  Token name;
  Property property;        ///< if it is no entity
  std::vector<Item> items;  ///< of an entity
};

/// `define NAME PARENT ( items )`.
struct Definition {
  Token parent;
  std::vector<Item> items;
};

class WorldParser {
 public:
  WorldParser(const IncludeFolders* folders, const std::string& path, Report* report)
      : folders_(folders), root_folder_(folder_of(path)), report_(report) {}

  Entity run(std::string_view text, const std::string& path) {
    file(text, path, 0);
    return std::move(root_);
  }

 private:
  /// A position in the tokens of one file.
  struct Cursor {
    const std::vector<Token>& tokens;
    std::size_t at = 0;
    [[nodiscard]] const Token& peek() const { return tokens[at]; }
    const Token& take() { return tokens[at + 1 < tokens.size() ? at++ : at]; }
  };

  [[noreturn]] static void fail(const Token& token, std::string expected, std::string hint = "") {
    throw ConfigError(issue_at(token.place, "stage/syntax", std::move(expected), described(token),
                               std::move(hint)));
  }

  void count(const Token& token) {
    if (++items_ > kMaxItems) {
      throw ConfigError(issue_at(token.place, "stage/too-large",
                                 "at most " + std::to_string(kMaxItems) +
                                     " properties and models, with those of definitions",
                                 "more"));
    }
  }

  void file(std::string_view text, const std::string& path, int depth) {
    const std::vector<Token> tokens = tokens_of(text, std::make_shared<const std::string>(path));
    Cursor cursor{tokens};
    while (cursor.peek().kind != TokenKind::kEnd) {
      const Token& token = cursor.peek();
      if (token.kind != TokenKind::kWord) {
        fail(token, "the name of a property or of a model",
             token.kind == TokenKind::kCloseEntity ? "is there a \"(\" too few?" : "");
      }
      if (folders_ != nullptr && token.text == "include") {
        include(cursor, path, depth);
      } else if (folders_ != nullptr && token.text == "define") {
        define(cursor);
      } else {
        add(root_, item(cursor, 0), 0);
      }
    }
  }

  /// `include "NAME"`.
  void include(Cursor& cursor, const std::string& from, int depth) {
    const Token word = cursor.take();
    const Token& name = cursor.take();
    if (name.kind != TokenKind::kString) fail(name, "the name of a file in double quotes");
    if (depth + 1 > kMaxIncludes) {
      throw ConfigError(issue_at(word.place, "stage/include",
                                 "files that do not include themselves", in_quotes(name.text),
                                 "are there two files that include each other?"));
    }
    const auto [text, path] = find_include(name, from);
    file(text, path, depth + 1);
  }

  /// Text and path of an included file.
  std::pair<std::string, std::string> find_include(const Token& name, const std::string& from) {
    const fs::path wanted(name.text);
    std::vector<fs::path> places;
    if (wanted.is_absolute()) {
      places.push_back(wanted);
      // A path of another computer: the file may lie beside the world.
      places.push_back(folder_of(from) / wanted.filename());
      places.push_back(root_folder_ / wanted.filename());
    } else {
      places.push_back(folder_of(from) / wanted);
      places.push_back(root_folder_ / wanted);
      for (const std::string& folder : folders_->before) {
        places.push_back(fs::path(folder) / wanted.filename());
      }
    }
    for (const fs::path& place : places) {
      if (auto text = content(name, place)) return {*text, place.string()};
    }
    for (const ShippedInclude& shipped : shipped_includes()) {
      if (wanted.filename() == shipped.name)
        return {shipped.text, std::string(kShippedFolder) + shipped.name};
    }
    for (const std::string& folder : folders_->after) {
      const fs::path place = fs::path(folder) / wanted.filename();
      if (auto text = content(name, place)) return {*text, place.string()};
    }
    std::vector<std::string> shipped;
    for (const ShippedInclude& file : shipped_includes()) shipped.emplace_back(file.name);
    throw ConfigError(issue_at(
        name.place, "stage/include",
        "a file in the folder of the world or in one of the folders of STAGEPATH, or one that "
        "Playpen has: " +
            list_text(shipped),
        "no " + in_quotes(name.text), "copy it beside the world file, or set STAGEPATH"));
  }

  /// Content of a file; nullopt if there is none.
  static std::optional<std::string> content(const Token& name, const fs::path& path) {
    std::string text;
    const auto error = read_whole_file(path.string(), {.most_bytes = kMaxFileBytes}, text);
    if (!error) return text;
    if (error->fault == FileFault::kMissing) return std::nullopt;
    throw ConfigError(issue_at(name.place, "stage/include", "a file that can be read",
                               path.string() + ": " + error->found));
  }

  /// `define NAME PARENT ( items )`.
  void define(Cursor& cursor) {
    cursor.take();
    const Token name = cursor.take();
    if (name.kind != TokenKind::kWord) fail(name, "the name of a definition");
    const Token parent = cursor.take();
    if (parent.kind != TokenKind::kWord) {
      fail(parent, "the model that " + in_quotes(name.text) + " is made from");
    }
    if (cursor.peek().kind != TokenKind::kOpenEntity) fail(cursor.peek(), "\"(\"");
    Definition definition{parent, items(cursor, 1)};
    const auto [first, is_new] = definitions_.emplace(name.text, std::move(definition));
    const Place& place = first->second.parent.place;
    if (is_new || (*place.file == *name.place.file && place.line == name.place.line)) return;
    report_->note("definition " + name.text, name.place,
                  "this definition of " + in_quotes(name.text) +
                      " has no effect: as in Stage, the first one counts, " + *place.file + ":" +
                      std::to_string(place.line));
  }

  /// `( items )`; the cursor is at the bracket.
  std::vector<Item> items(Cursor& cursor, int depth) {
    const Token open = cursor.take();
    if (depth > kMaxNesting) {
      throw ConfigError(issue_at(open.place, "stage/too-deep",
                                 "at most " + std::to_string(kMaxNesting) + " models in each other",
                                 "more"));
    }
    std::vector<Item> all;
    while (cursor.peek().kind != TokenKind::kCloseEntity) {
      const Token& token = cursor.peek();
      if (token.kind != TokenKind::kWord) {
        fail(token, "the name of a property or of a model, or \")\"",
             token.kind == TokenKind::kEnd
                 ? "the \"(\" of line " + std::to_string(open.place.line) + " is not closed"
                 : "");
      }
      all.push_back(item(cursor, depth));
    }
    cursor.take();
    return all;
  }

  /// A property or an entity; the cursor is at its name.
  Item item(Cursor& cursor, int depth) {
    Item made;
    made.name = cursor.take();
    count(made.name);
    const Token& next = cursor.peek();
    if (next.kind == TokenKind::kOpenEntity) {
      made.is_entity = true;
      made.items = items(cursor, depth + 1);
      return made;
    }
    made.property.name = made.name.text;
    made.property.place = made.name.place;
    if (next.kind == TokenKind::kOpenTuple) {
      const Token open = cursor.take();
      made.property.is_tuple = true;
      while (cursor.peek().kind != TokenKind::kCloseTuple) {
        const Token& token = cursor.peek();
        if (token.kind != TokenKind::kNumber && token.kind != TokenKind::kString) {
          fail(token, "a number, a text in double quotes, or \"]\"",
               "the \"[\" of line " + std::to_string(open.place.line) + " is not closed");
        }
        count(token);
        made.property.values.push_back(value(cursor.take()));
      }
      cursor.take();
      return made;
    }
    const bool is_flag =
        folders_ == nullptr && next.kind == TokenKind::kWord &&
        (next.text == "true" || next.text == "false");  // Player's files know these
    if (next.kind != TokenKind::kNumber && next.kind != TokenKind::kString && !is_flag) {
      fail(next, "the value of " + in_quotes(made.name.text) + ", or \"(\" if it is a model",
           next.kind == TokenKind::kWord ? "texts stand in double quotes" : "");
    }
    made.property.values.push_back(value(cursor.take()));
    return made;
  }

  Value value(const Token& token) {
    if (token.cut && report_ != nullptr) {
      report_->note("number " + token.text, token.place,
                    "the number " + token.text + " is read as " + number_text(token.number) +
                        ", as in Stage");
    }
    return {token.kind != TokenKind::kNumber, token.number, token.text, token.place};
  }

  /// Adds an item to an entity, with everything that it inherits.
  void add(Entity& owner, const Item& item, int depth) {
    count(item.name);
    if (!item.is_entity) {
      owner.set(item.property);
      return;
    }
    Entity entity;
    entity.place = item.name.place;
    inherit(entity, item.name, depth);
    for (const Item& one : item.items) add(entity, one, depth + 1);
    owner.children.push_back(std::move(entity));
  }

  /// Gives an entity the properties and models of its definitions, the farthest first.
  void inherit(Entity& entity, const Token& type, int depth) {
    if (depth > kMaxNesting) {
      throw ConfigError(issue_at(type.place, "stage/too-deep",
                                 "definitions that do not contain themselves",
                                 in_quotes(type.text)));
    }
    const auto found = definitions_.find(type.text);
    if (found == definitions_.end()) {
      entity.type = type.text;
      return;
    }
    const Definition& definition = found->second;
    entity.kinds.push_back(type.text);
    inherit(entity, definition.parent, depth + 1);
    for (const Item& one : definition.items) add(entity, one, depth + 1);
  }

  const IncludeFolders* folders_;  ///< null: a file without includes and definitions
  fs::path root_folder_;
  Report* report_;  ///< null: nothing is reported
  std::map<std::string, Definition> definitions_;
  std::size_t items_ = 0;
  Entity root_;
};

}  // namespace

const Property* Entity::find(std::string_view name) const {
  for (const Property& property : properties) {
    if (property.name != name) continue;
    property.used = true;
    return &property;
  }
  return nullptr;
}

void Entity::set(Property property) {
  const auto same = std::find_if(properties.begin(), properties.end(),
                                 [&](const Property& p) { return p.name == property.name; });
  if (same == properties.end()) {
    properties.push_back(std::move(property));
  } else {
    *same = std::move(property);
  }
}

IncludeFolders include_folders() {
  IncludeFolders folders;
  if (const char* path = std::getenv("STAGEPATH")) {
    std::string_view rest(path);
    while (!rest.empty()) {
      const std::size_t colon = std::min(rest.find(':'), rest.size());
      if (colon > 0) folders.before.emplace_back(rest.substr(0, colon));
      rest.remove_prefix(std::min(colon + 1, rest.size()));
    }
  }
  folders.after = {"/usr/share/stage/worlds", "/usr/local/share/stage/worlds", "/usr/share/stage",
                   "/usr/local/share/stage"};
  return folders;
}

Entity read_world_file(std::string_view text, const std::string& path,
                       const IncludeFolders& folders, Report& report) {
  return WorldParser(&folders, path, &report).run(text, path);
}

Entity read_player_file(std::string_view text, const std::string& path) {
  return WorldParser(nullptr, path, nullptr).run(text, path);
}

}  // namespace sim::io::stage
