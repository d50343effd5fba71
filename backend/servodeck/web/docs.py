"""The API's description as a page without a script, so that it works offline and under the strict content
policy.

Knows OpenAPI, no route of ours: everything shown comes from the schema.
"""

import json
from html import escape
from typing import Any

# More than anybody wants to read in the middle of a line.
MANY = 8
METHODS = ("get", "put", "post", "patch", "delete")

STYLE = """
:root { color-scheme: light dark; font: 16px/1.5 system-ui, sans-serif; }
body { max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
section { border-top: 1px solid color-mix(in srgb, currentColor 20%, transparent); padding: 0.5rem 0 1rem; }
h2 { font-size: 1rem; font-family: ui-monospace, monospace; overflow-wrap: anywhere; }
h2 span { display: inline-block; min-width: 5rem; font-weight: 700; text-transform: uppercase; }
table { border-collapse: collapse; }
th, td { text-align: left; vertical-align: top; padding: 0.2rem 1.5rem 0.2rem 0; font-weight: normal; }
details { color: color-mix(in srgb, currentColor 75%, transparent); font-size: 0.875rem; }
code { font-family: ui-monospace, monospace; overflow-wrap: anywhere; }
"""


def docs_page(schema: dict[str, Any]) -> str:
    sections = [
        operation(method, path, methods[method], schema)
        for path, methods in schema["paths"].items()
        for method in METHODS
        if method in methods
    ]
    info = schema["info"]
    title = escape(f"{info['title']} {info['version']}")
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width">'
        f'<title>{title}</title><link rel="stylesheet" href="docs.css"></head><body>'
        f"<h1>{title}</h1><p>{escape(info['description'])}</p>"
        '<p>For programs: <a href="openapi.json">openapi.json</a></p>'
        f"{''.join(sections)}</body></html>"
    )


def operation(method: str, path: str, description: dict[str, Any], schema: dict[str, Any]) -> str:
    said = {"body": description["requestBody"]} if "requestBody" in description else {}
    rows = "".join(
        f"<tr><th>{escape(label)}</th><td>{content(part, schema)}</td></tr>"
        for label, part in {**said, **description["responses"]}.items()
    )
    return (
        f"<section><h2><span>{method}</span>{escape(path)}</h2>"
        f"<p>{escape(description.get('description', ''))}</p><table>{rows}</table></section>"
    )


def content(part: dict[str, Any], schema: dict[str, Any]) -> str:
    """An example and its shape; of errors, which all have one shape, their codes."""
    for found in part.get("content", {}).values():
        if "examples" in found:
            return ", ".join(f"{each['summary']} {code}" for code, each in found["examples"].items())
        example = escape(json.dumps(found["example"], ensure_ascii=False))
        fields = shape(found.get("schema", {}), schema)
        return f"<code>{example}</code><details><summary>all fields</summary>{fields}</details>"
    return "nothing"


def shape(part: dict[str, Any], schema: dict[str, Any]) -> str:
    """One line of a type: `{device: string, likely: boolean}`."""
    if "$ref" in part:
        part = schema["components"]["schemas"][part["$ref"].rsplit("/", 1)[1]]
    if "anyOf" in part:
        return " or ".join(shape(each, schema) for each in part["anyOf"])
    if len(part.get("enum", ())) > MANY:
        return "a code"
    if "enum" in part:
        return " or ".join(f"<code>{escape(str(each))}</code>" for each in part["enum"])
    if "const" in part:
        return f"<code>{escape(str(part['const']))}</code>"
    if part.get("type") == "array":
        return f"list of {shape(part['items'], schema)}"
    if "properties" in part:
        fields = [
            f"<code>{escape(name)}</code>: {shape(each, schema)}" for name, each in part["properties"].items()
        ]
        return "{ " + ", ".join(fields) + " }"
    return escape(str(part.get("type", "nothing")))
