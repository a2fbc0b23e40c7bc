"""The JSON Schema by an independent validator: right scenes validate, scenes whose structure is wrong do not.

`cargo xtask prove schema` writes the scenes into a folder and calls this with it.
"""

import json
import pathlib
import sys

import jsonschema_rs


def main(folder):
    def read(path):
        return json.loads(path.read_text(encoding="utf-8"))

    schema = read(folder / "schema.json")
    jsonschema_rs.meta.validate(schema)
    validator = jsonschema_rs.Draft7Validator(schema)
    faults, count = [], {}
    for name in ("right", "wrong"):
        paths = sorted((folder / name).glob("*.json"))
        count[name] = len(paths)
        for path in paths:
            errors = [str(error) for error in validator.iter_errors(read(path))]
            if name == "right" and errors:
                faults.append(f"the schema refuses {path}:\n" + "\n".join(errors))
            if name == "wrong" and not errors:
                faults.append(f"the schema takes {path}")
    if faults or not (count["right"] and count["wrong"]):
        sys.exit("\n".join(faults) or "no scenes to ask about")
    print(f"{count['right']} scenes validate, {count['wrong']} do not: all is well")


main(pathlib.Path(sys.argv[1]))
