// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/entity.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "io/document.h"
#include "io/stage/file_search.h"
#include "io/stage/report.h"
#include "sim/core/file.h"

namespace sim::io::stage {
namespace {

namespace fs = std::filesystem;

// Limits far beyond any real world, so that a small file cannot take all memory.
constexpr int kMaxNesting = 32;
constexpr int kMaxIncludeDepth = 32;
constexpr int kMaxIncludes = 1000;
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

/// The tokens of a file, with those of its includes in their place, as in Stage and in Player.
class Includer {
 public:
  /// @param shipped  whether files that come with Playpen are looked for.
  Includer(const std::string& path, bool shipped, Report& report)
      : folders_{"", folder_of(path)}, shipped_(shipped), report_(report) {
    for (fs::path& folder : stage_folders()) folders_.push_back(std::move(folder));
  }

  std::vector<Token> run(std::string_view text, const std::string& path) {
    file(text, path, 0);
    return std::move(tokens_);
  }

 private:
  void file(std::string_view text, const std::string& path, int depth) {
    std::vector<Token> own = tokens_of(text, std::make_shared<const std::string>(utf8_text(path)));
    for (std::size_t i = 0; i < own.size(); ++i) {
      const bool is_end = own[i].kind == TokenKind::kEnd;
      if (own[i].kind == TokenKind::kWord && own[i].text == "include") {
        include(own[i], own[i + 1], path, depth);
        ++i;
      } else if (!is_end || depth == 0) {
        tokens_.push_back(std::move(own[i]));
      }
    }
  }

  /// `include "NAME"`.
  void include(const Token& word, const Token& name, const std::string& from, int depth) {
    if (name.kind != TokenKind::kString) {
      throw ConfigError(issue_at(name.place, "stage/syntax", "the name of a file in double quotes",
                                 described(name)));
    }
    if (depth + 1 > kMaxIncludeDepth) {
      throw ConfigError(issue_at(word.place, "stage/include",
                                 "files that do not include themselves", in_quotes(name.text),
                                 "are there two files that include each other?"));
    }
    if (++includes_ > kMaxIncludes) {
      throw ConfigError(issue_at(
          word.place, "stage/include",
          "at most " + std::to_string(kMaxIncludes) + " files, each as often as it is included",
          "more, with " + in_quotes(name.text),
          "files that include others twice are read twice as often at each "
          "level"));
    }
    const auto [text, path] = find_include(name, from);
    included_bytes_ += text.size();
    if (included_bytes_ > kMaxFileBytes) {
      throw ConfigError(issue_at(word.place, "stage/too-large",
                                 "at most 16 MiB of text in all included files, each as often as "
                                 "it is included",
                                 "more, with " + in_quotes(name.text)));
    }
    file(text, path, depth + 1);
  }

  /// Text and path of an included file: beside the file that includes it, beside the main file, in
  /// the folders of Stage, and at last one that comes with Playpen.
  std::pair<std::string, std::string> find_include(const Token& name, const std::string& from) {
    folders_.front() = folder_of(from);
    if (const auto found = find_file(name.text, folders_)) {
      std::string text;
      const auto error = read_whole_file(found->path, {.most_bytes = kMaxFileBytes}, text);
      if (error) {
        throw ConfigError(issue_at(name.place, "stage/include", "a file that can be read",
                                   utf8_text(found->path) + ": " + error->found));
      }
      if (found->by_base_name) note_other_path(name.text, found->path, name.place, report_);
      return {std::move(text), found->path};
    }
    const fs::path wanted(name.text);
    std::vector<std::string> known;
    for (const ShippedInclude& shipped : shipped_includes()) {
      if (!shipped_) break;
      known.emplace_back(shipped.name);
      if (wanted.filename() != shipped.name) continue;
      const std::string path = std::string(kShippedFolder) + shipped.name;
      if (wanted.has_parent_path()) note_other_path(name.text, path, name.place, report_);
      return {shipped.text, path};
    }
    throw ConfigError(issue_at(
        name.place, "stage/include",
        std::string("a file in the folder of this one or in one of the folders of STAGEPATH") +
            (known.empty() ? "" : ", or one that Playpen has: " + list_text(known)),
        "no " + in_quotes(name.text),
        "copy it beside the " + std::string(shipped_ ? "world" : "configuration") +
            " file, or set STAGEPATH"));
  }

  std::vector<fs::path> folders_;
  bool shipped_;
  Report& report_;
  int includes_ = 0;
  std::size_t included_bytes_ = 0;
  std::vector<Token> tokens_;
};

/// Reads world files of Stage and configuration files of Player.
class WorldParser {
 public:
  WorldParser(const std::vector<Token>& tokens, bool has_flags, Report& report)
      : tokens_(tokens), has_flags_(has_flags), report_(report) {}

  Entity run() {
    Cursor cursor{tokens_};
    while (cursor.peek().kind != TokenKind::kEnd) {
      const Token& token = cursor.peek();
      if (token.kind != TokenKind::kWord) {
        fail(token, "the name of a property or of a model",
             token.kind == TokenKind::kCloseEntity ? "is there a \"(\" too few?" : "");
      }
      if (token.text == "define") {
        define(cursor);
      } else {
        add(root_, item(cursor, 0), 0);
      }
    }
    return std::move(root_);
  }

 private:
  /// A position in the tokens.
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
    report_.note("definition " + name.text, name.place,
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
        has_flags_ && next.kind == TokenKind::kWord &&
        (next.text == "true" || next.text == "false" || next.text == "yes" || next.text == "no");
    if (next.kind != TokenKind::kNumber && next.kind != TokenKind::kString && !is_flag) {
      fail(next, "the value of " + in_quotes(made.name.text) + ", or \"(\" if it is a model",
           next.kind == TokenKind::kWord ? "texts stand in double quotes" : "");
    }
    made.property.values.push_back(value(cursor.take()));
    return made;
  }

  Value value(const Token& token) {
    if (token.cut) {
      report_.note("number " + token.text, token.place,
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

  const std::vector<Token>& tokens_;
  bool has_flags_;  ///< whether values may be true, false, yes and no, as in Player's files
  Report& report_;
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

Entity read_world_file(std::string_view text, const std::string& path, Report& report) {
  const std::vector<Token> tokens = Includer(path, true, report).run(text, path);
  return WorldParser(tokens, false, report).run();
}

Entity read_player_file(std::string_view text, const std::string& path, Report& report) {
  const std::vector<Token> tokens = Includer(path, false, report).run(text, path);
  return WorldParser(tokens, true, report).run();
}

}  // namespace sim::io::stage
