#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Checks world and task files against their JSON schemas, and that these refuse what they can.

Usage: world_schema_test.py SOURCE_DIR
"""

import json
import pathlib
import re
import sys

try:
    import jsonschema
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

# A string or a comment. Strings come first, so that "//" inside a string stays.
TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)

# Bad worlds with an error of form, which a schema can detect.
FORMAL_FAULTS = ["unknown_key", "wrong_type", "out_of_range", "unknown_value", "bad_colour",
                 "bad_colour_of_obstacle", "bad_name", "missing_key", "reserved_port", "conflicting_keys",
                 "obstacle_too_thin", "obstacle_next_to_nothing", "separator_too_thin",
                 "fuzz_no_shape", "fuzz_speed", "fuzz_unknown_key", "fuzz_unknown_shape", "fuzz_word_twice",
                 "arena_fault_kind", "map_resolution_too_fine", "arena_action_without_kind", "arena_action_unknown",
                 "arena_action_two_kinds", "arena_action_wrong_type", "arena_canvas_half",
                 "arena_condition_two_kinds", "arena_configuration_name", "arena_end_verdict",
                 "arena_end_without_verdict", "arena_message_too_long", "arena_timer_at_and_within",
                 "arena_timer_every", "arena_timer_unknown_key", "arena_trap_near_two", "arena_trap_on",
                 "arena_trap_polygon", "arena_trap_radius", "arena_trap_two_places",
                 "arena_trap_without_place", "when_blocked",
                 "circle_with_size", "circle_without_radius",
                 "circle_too_small", "outline_missing", "outline_of_two_points",
                 "outline_of_too_many_points", "outline_not_a_number", "outline_without_shape",
                 "separator_with_shape", "unknown_shape",
                 "arena_move_nowhere", "arena_move_stop_and_to", "arena_move_to_and_path",
                 "arena_move_without_obstacle", "friction_without_mass", "mass_out_of_range",
                 "motion_area_without_size", "motion_force", "motion_no_points",
                 "motion_point_is_no_pair", "motion_repeat", "motion_speed", "motion_type",
                 "motion_unknown_key", "motion_without_points", "motion_without_type"]


BAD_RUBRICS = [
    [], [{"points": 1}], [{"figure": "speed", "points": 1}], [{"figure": "passed"}],
    [{"figure": "passed", "points": 0}], [{"figure": "passed", "points": 1, "best": 1}],
    [{"figure": "score", "points": 1}], [{"figure": "score", "points": 1, "best": 1}],
    [{"figure": "score", "points": 1, "steps": [{"at_most": 1, "points": 1}]}],
    [{"figure": "score", "steps": []}], [{"figure": "score", "steps": [{"points": 1}]}],
    [{"figure": "score", "steps": [{"at_most": 1, "at_least": 1, "points": 1}]}]]


def parse(text):
    return json.loads(TOKEN.sub(lambda m: m[0] if m[0][0] == '"' else " ", text))


def load(path):
    return parse(path.read_text(encoding="utf-8"))


def main(source):
    worlds = source / "worlds"
    schema = load(worlds / "schema" / "world.schema.json")
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    failures = 0

    tasks = sorted(worlds.rglob("*.task.json"))
    good = [p for p in sorted(worlds.rglob("*.json"))
            if p.parent.name not in ("schema", "models") and p not in tasks]
    for path in good:
        for error in validator.iter_errors(load(path)):
            print(f"{path}: {error.json_path}: {error.message}")
            failures += 1
    if len(good) < 7:
        print(f"only {len(good)} worlds in {worlds}")
        failures += 1

    # Inlines the parts that it references from the worlds' schema.
    model_schema = load(worlds / "schema" / "model.schema.json")
    model_schema["properties"]["devices"] = schema["$defs"]["robot"]["properties"]["devices"]
    model_schema["$defs"] = {**schema["$defs"], **model_schema["$defs"]}
    jsonschema.Draft202012Validator.check_schema(model_schema)
    model_validator = jsonschema.Draft202012Validator(model_schema)
    models = sorted((worlds / "models").glob("*.json"))
    for path in models:
        for error in model_validator.iter_errors(load(path)):
            print(f"{path}: {error.json_path}: {error.message}")
            failures += 1
    if len(models) < 5:
        print(f"only {len(models)} models in {worlds}")
        failures += 1
    outline = [[0, 0], [1, 0], [0, 1]]
    for bad in [{}, {"name": "a"}, {"name": "a", "footprint": outline[:2]},
                {"name": "a", "footprint": outline, "weels": 4},
                {"name": "a", "footprint": outline, "superstructures": [{"outline": outline}]},
                {"name": "a", "footprint": outline, "drive": {"kind": "hover"}}]:
        if model_validator.is_valid(bad):
            print(f"the model schema accepts {bad}")
            failures += 1

    task_schema = load(worlds / "schema" / "task.schema.json")
    jsonschema.Draft202012Validator.check_schema(task_schema)
    task_validator = jsonschema.Draft202012Validator(task_schema)
    for path in tasks:
        for error in task_validator.iter_errors(load(path)):
            print(f"{path}: {error.json_path}: {error.message}")
            failures += 1
    if len(tasks) < 3:
        print(f"only {len(tasks)} tasks in {worlds}")
        failures += 1
    page = (source / "docs" / "grading.md").read_text(encoding="utf-8")
    for example in re.findall(r"```json\n(.*?)```", page, re.DOTALL):
        for error in task_validator.iter_errors(parse(example)):
            print(f"docs/grading.md: {error.json_path}: {error.message}")
            failures += 1
    for bad in [{}, {"worlds": []}, {"worlds": [1]}, {"worlds": ["a.json"], "sedes": 3},
                {"worlds": ["a.json"], "thresholds": {"min_coverage": 98}},
                *({"worlds": ["a.json"], "rubric": rubric} for rubric in BAD_RUBRICS)]:
        if task_validator.is_valid(bad):
            print(f"the task schema accepts {bad}")
            failures += 1

    plan_schema = load(worlds / "schema" / "plan.schema.json")
    jsonschema.Draft202012Validator.check_schema(plan_schema)
    plan_validator = jsonschema.Draft202012Validator(plan_schema)
    page = (source / "docs" / "batch.md").read_text(encoding="utf-8")
    plans = re.findall(r"^ *```\n( *\{.*?)```", page, re.DOTALL | re.MULTILINE)
    for example in plans:
        for error in plan_validator.iter_errors(parse(example)):
            print(f"docs/batch.md: {error.json_path}: {error.message}")
            failures += 1
    if not plans:
        print("docs/batch.md has no plan")
        failures += 1
    plan = {"programs": ["robot"], "worlds": ["cave"]}
    for bad in [{}, {"programs": ["robot"]}, {**plan, "programs": []}, {**plan, "sedes": 3},
                {**plan, "seeds": [1, 1]}, {**plan, "parameters": {"a": [1]}},
                {**plan, "parameters": {"/a~2": [1]}}, {**plan, "parameters": {"/a": []}},
                {**plan, "parameters": {"/a": {"from": 1, "to": 2}}}]:
        if plan_validator.is_valid(bad):
            print(f"the plan schema accepts {bad}")
            failures += 1

    for name in FORMAL_FAULTS:
        path = source / "tests" / "invalid_worlds" / f"{name}.json"
        if validator.is_valid(load(path)):
            print(f"{path}: the schema accepts it")
            failures += 1
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
