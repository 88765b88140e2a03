"""The types in crossguard.lua from the ASN.1 modules.

Compares the file with the modules and ends with 1 where it differs; with CROSSGUARD_BLESS=1 in the
environment, writes the file instead. Needs asn1tools, which codec/judges/run installs.
"""

import os
import pathlib
import re
import sys

import asn1tools

HERE = pathlib.Path(__file__).parent
MODULES = ["CDD", "Common", "VAM", "RAM", "RMCM"]
MARK = "-- == Types, generated ==\n"


def parse():
    files = [str(HERE.parent / f"asn1/Crossguard-{name}.asn") for name in MODULES]
    types = {}
    for module in asn1tools.parse_files(files).values():
        types.update(module["types"])
    return types


def bounds(restriction):
    """First and last number of a range or size, and whether more may come."""
    first = next(one for one in restriction if one is not None)
    low, high = first if isinstance(first, (tuple, list)) else (first, first)
    return low, high, None in restriction


def leaf(leaves, name, kind):
    """Notes what a field of this name holds: what fits all fields of the name."""
    known = leaves.get(name, kind)
    if known != kind:
        kind = "string" if "string" in (known, kind) else "int32"
    leaves[name] = kind


def lua_names(names):
    inside = ", ".join(f'[{number}] = "{name}"' for name, number in names)
    return "{ " + inside + " }" if inside else None


def convert(one, types, leaves, name):
    """A type as a Lua table, on one line."""
    kind = one["type"]
    if kind in types and "size" not in one and "restricted-to" not in one:
        note(kind, types, leaves, name)
        return f'"{kind}"'
    if kind in types:
        one = {**types[kind], **one, "type": types[kind]["type"]}
        kind = one["type"]
    if kind == "BOOLEAN":
        leaf(leaves, name, "string")
        return '{ k = "bool" }'
    if kind == "NULL":
        leaf(leaves, name, "string")
        return '{ k = "null" }'
    if kind == "INTEGER":
        low, high, extensible = bounds(one["restricted-to"])
        leaf(leaves, name, "uint32" if low >= 0 else "int32")
        parts = [f'k = "int", min = {low}, max = {high}']
        if extensible:
            parts.append("ext = true")
        named = lua_names(sorted(one.get("named-numbers", {}).items(), key=lambda n: n[1]))
        if named:
            parts.append(f"names = {named}")
        return "{ " + ", ".join(parts) + " }"
    if kind == "ENUMERATED":
        leaf(leaves, name, "string")
        root = [v[0] for v in one["values"][: cut(one["values"])]]
        extensible = ", ext = true" if None in one["values"] else ""
        return '{ k = "enum", root = { ' + ", ".join(f'"{v}"' for v in root) + " }" + extensible + " }"
    if kind == "BIT STRING":
        leaf(leaves, name, "string")
        low, high, _ = bounds(one["size"])
        bits = [(n, int(b)) for n, b in one.get("named-bits", [])]
        named = lua_names(bits)
        named = f", names = {named}" if named else ""
        return f'{{ k = "bits", min = {low}, max = {high}{named} }}'
    if kind == "SEQUENCE":
        members = one["members"]
        parts = ['k = "seq"']
        if cut(members) != len(members):
            parts.append("ext = true")
        for member in members[: cut(members)]:
            inner = convert(member, types, leaves, member["name"])
            optional = ", opt = true" if member.get("optional") or "default" in member else ""
            parts.append(f'{{ "{member["name"]}", {inner}{optional} }}')
        return "{ " + ", ".join(parts) + " }"
    if kind == "SEQUENCE OF":
        low, high, extensible = bounds(one["size"])
        inner = convert(one["element"], types, leaves, "item")
        extensible = ", ext = true" if extensible else ""
        return f'{{ k = "list", min = {low}, max = {high}, of = {inner}{extensible} }}'
    if kind == "CHOICE":
        members = one["members"]
        alternatives = lambda part: ", ".join(
            f'{{ "{m["name"]}", {convert(m, types, leaves, m["name"])} }}' for m in part
        )
        end = cut(members)
        text = 'k = "choice", root = { ' + alternatives(members[:end]) + " }"
        if end != len(members):
            text += ", ext = true, adds = { " + alternatives(members[end + 1 :]) + " }"
        return "{ " + text + " }"
    raise SystemExit(f"{kind} is not supported")


def cut(members):
    """Where the extension marker stands."""
    for index, member in enumerate(members):
        if member is None:
            return index
    return len(members)


def note(kind, types, leaves, name):
    """Notes the field of a leaf that is a type of its own."""
    one = types[kind]
    if one["type"] in ("NULL", "BOOLEAN", "INTEGER", "ENUMERATED", "BIT STRING"):
        convert(one, types, leaves, name)
    elif one["type"] in types:
        note(one["type"], types, leaves, name)


def reachable(types, roots):
    seen, todo = [], list(roots)
    while todo:
        name = todo.pop()
        if name in seen:
            continue
        seen.append(name)
        todo += [t for t in re.findall(r'"([A-Z]\w+)"', convert(types[name], types, {}, "x")) if t in types]
    return sorted(seen)


def generate():
    types, leaves, lines = parse(), {}, []
    for name in reachable(types, ["RAM", "RMCM"]):
        lines.append(f"types.{name} = {convert(types[name], types, leaves, name)}")
    lines.append("")
    kinds = {}
    for name, kind in sorted(leaves.items()):
        if not name[0].isupper():
            kinds.setdefault(kind, []).append(name)
    for kind, names in sorted(kinds.items()):
        lines.append(f"for _, name in ipairs({{ " + ", ".join(f'"{n}"' for n in names) + " }) do")
        lines.append(f'    fields[name] = ProtoField.{kind}("crossguard." .. name, name)')
        if kind == "string":
            lines.append("    texts[name] = true")
        lines.append("end")
    lines.append("")
    lines.append("crossguard.fields = fields")
    text = (HERE / "crossguard.lua").read_text()
    return text[: text.index(MARK) + len(MARK)] + "\n" + "\n".join(lines) + "\n"


if __name__ == "__main__":
    if "CROSSGUARD_BLESS" in os.environ:
        (HERE / "crossguard.lua").write_text(generate())
    elif generate() != (HERE / "crossguard.lua").read_text():
        sys.exit("crossguard.lua is out of date: cargo xtask bless crossguard.lua")
