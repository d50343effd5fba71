"""`npm run package`: the wheel, the libraries to install it with, a bill of materials and the licences.

Needs the built page and this environment. What is written names no host: pip and npm take theirs.
"""

import json
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterable, Mapping
from email.message import Message
from importlib.metadata import PackageNotFoundError, distribution, metadata, requires
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parent.parent
STATIC = ROOT / "backend" / "servodeck" / "static"
PAGE_LICENCES = "third-party-licences.txt"
LOCK = ROOT / "backend" / "requirements.lock"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
ABOUT = f"""\
# What Servodeck {PROJECT["version"]} was tested with, by hash. Install it before the wheel:
#   pip install --require-hashes -r THIS_FILE
#   pip install --no-deps servodeck-{PROJECT["version"]}-py3-none-any.whl
"""


def main() -> int:
    folder = ROOT / "dist"
    folder.mkdir(exist_ok=True)
    wheel = build_wheel(folder)
    locked = locked_requirements(LOCK.read_text(), PROJECT["dependencies"])
    stem = f"servodeck-{PROJECT['version']}"
    requirements = folder / f"{stem}-requirements.txt"
    requirements.write_text(ABOUT + "".join(locked.values()))
    bill = folder / f"{stem}-sbom.cdx.json"
    bill.write_text(json.dumps(bill_of(page_bill(), locked), indent=2) + "\n")
    licences = folder / f"{stem}-licences.txt"
    licences.write_text((STATIC / PAGE_LICENCES).read_text("utf-8") + library_texts(locked), "utf-8")
    for made in (wheel, requirements, bill, licences):
        print(made.relative_to(ROOT))
    return 0


def build_wheel(folder: Path) -> Path:
    if not (STATIC / "index.html").exists():
        sys.exit("The page is not built: npm run build")
    command = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", str(folder)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, cwd=ROOT)
    return folder / f"servodeck-{PROJECT['version']}-py3-none-any.whl"


def locked_requirements(lock: str, wanted: Iterable[str]) -> Mapping[str, str]:
    """The entries of a lock file, with their hashes, of these libraries and all that they need."""
    entries = entries_of(lock)
    found: dict[str, str] = {}
    waiting = [Requirement(one) for one in wanted]
    seen: set[tuple[str, frozenset[str]]] = set()
    while waiting:
        requirement = waiting.pop()
        name, extras = canonicalize_name(requirement.name), frozenset(requirement.extras)
        if (name, extras) in seen:
            continue
        seen.add((name, extras))
        if name not in entries:
            raise KeyError(f"{name} is not in the lock file")
        found[name] = entries[name]
        waiting += needed_by(name, extras)
    return dict(sorted(found.items()))


def entries_of(lock: str) -> Mapping[str, str]:
    """Without the comments on who needs what: they name tools of the developers too."""
    lines = [line for line in lock.splitlines(keepends=True) if not line.lstrip().startswith("#")]
    entries: dict[str, str] = {}
    name = ""
    for line in lines:
        if head := re.match(r"([A-Za-z0-9][A-Za-z0-9._-]*)(?=[=\[ ])", line):
            name = canonicalize_name(head[1])
        entries[name] = entries.get(name, "") + line
    entries.pop("", None)
    return entries


def needed_by(name: str, extras: frozenset[str]) -> list[Requirement]:
    """On any system. One that is not installed here is for another system, and needs none."""
    try:
        needed = [Requirement(one) for one in requires(name) or []]
    except PackageNotFoundError:
        return []
    return [one for one in needed if is_wanted(one, extras)]


def is_wanted(requirement: Requirement, extras: frozenset[str]) -> bool:
    """On some system: the lock file says itself where a library is wanted. Extras and old Pythons count."""
    if requirement.marker is None:
        return True
    systems: tuple[dict[str, str], ...] = (
        {},
        {"sys_platform": "win32", "platform_system": "Windows", "os_name": "nt"},
        {"sys_platform": "darwin", "platform_system": "Darwin"},
    )
    return any(
        requirement.marker.evaluate({**system, "extra": extra})
        for system in systems
        for extra in {"", *extras}
    )


def page_bill() -> dict[str, object]:
    """Of the libraries in the page, by npm, which knows its lock file."""
    command = ["npm", "sbom", "--sbom-format=cyclonedx", "--omit=dev", "--package-lock-only"]
    output = subprocess.run(command, check=True, stdout=subprocess.PIPE, cwd=ROOT).stdout
    bill: dict[str, object] = json.loads(output)
    return bill


def bill_of(bill: dict[str, object], locked: Mapping[str, str]) -> dict[str, object]:
    components = bill.get("components", [])
    assert isinstance(components, list)
    return {
        **bill,
        "components": [*components, *(component(name, entry) for name, entry in locked.items())],
        "metadata": {
            "component": {
                "type": "application",
                "name": "servodeck",
                "version": PROJECT["version"],
                "licenses": [{"license": {"id": PROJECT["license"]}}],
            }
        },
    }


def component(name: str, entry: str) -> dict[str, object]:
    version = re.search(r"==([^\s;\\]+)", entry)
    assert version
    package = f"pkg:pypi/{name}@{version[1]}"
    hashes = re.findall(r"sha256:([0-9a-f]{64})", entry)
    return {
        "type": "library",
        "name": name,
        "version": version[1],
        "purl": package,
        "bom-ref": package,
        "hashes": [{"alg": "SHA-256", "content": found} for found in hashes],
        "licenses": licences_of(name),
    }


def licences_of(name: str) -> list[dict[str, object]]:
    """As the library says it; empty where it says nothing, or is for another system."""
    try:
        about = metadata(name)
        assert isinstance(about, Message)
    except PackageNotFoundError:
        return []
    expression = about.get("License-Expression")
    if expression:
        return [{"expression": expression}]
    classifiers = [one for one in about.get_all("Classifier") or [] if one.startswith("License ::")]
    names = [one.split(" :: ")[-1] for one in classifiers] or (about.get("License") or "").splitlines()
    return [{"license": {"name": names[0]}}] if names else []


LINE = "=" * 80


def library_texts(names: Iterable[str]) -> str:
    """The licences of these Python libraries, in the form of scripts/licences.mjs. Those for other systems
    are not installed here, and bring their own.
    """
    return "".join(library_text(name) for name in names)


def library_text(name: str) -> str:
    """Raises ValueError for one that is installed without its licence's name or text."""
    try:
        found = distribution(name)
    except PackageNotFoundError:
        return ""
    licence = next(iter(licences_of(name)), None)
    files = [one for one in found.files or () if one.parts[0].endswith(".dist-info")]
    of_licence = [
        one
        for one in files
        if "licenses" in one.parts or re.match(r"(?i)licen[cs]e|copying|notice", one.name)
    ]
    texts = [one.read_text("utf-8").strip() for one in of_licence]
    own = ROOT / "packaging" / "licences" / f"{name}.txt"
    texts = texts or ([own.read_text("utf-8").strip()] if own.exists() else [])
    if licence is None or not texts:
        raise ValueError(f"{name} is installed without its licence")
    said = licence.get("expression") or licence["license"]
    called = said["name"] if isinstance(said, dict) else said
    text = "\n\n".join(texts)
    return f"{LINE}\n{name} {found.version} ({called})\n{LINE}\n\n{text}\n\n"


if __name__ == "__main__":
    sys.exit(main())
