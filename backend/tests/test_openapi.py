"""The description of the HTTP interface: whole, and true to the models."""

import json
import re
from typing import Any, get_args

import pytest
from fastapi.routing import APIRoute
from jsonschema_rs import validator_for
from pydantic import TypeAdapter

from servodeck.api.app import LaterApp
from servodeck.api.examples import EXAMPLES, PROBLEMS
from servodeck.api.openapi import SCHEMES, STATUS_OF, described, docs_page, operations
from servodeck.callers import Role
from servodeck.errors import ErrorCode
from tests.knocking import app_at
from tests.test_matrix import ROLES

application = app_at().app
assert isinstance(application, LaterApp)
application.load_all()
SCHEMA = described(application)
ROUTES = list(operations(application))


def test_every_route_has_its_example_and_no_example_is_of_a_route_that_is_gone() -> None:
    assert {(method, route.path) for route, method, _ in ROUTES} == set(EXAMPLES)


@pytest.mark.parametrize(
    ("route", "method", "role"), ROUTES, ids=lambda value: str(getattr(value, "path", value))
)
def test_every_route_says_what_it_does_for_whom_and_what_may_come_back(
    route: APIRoute, method: str, role: Role | None
) -> None:
    operation = SCHEMA["paths"][route.path][method.lower()]
    assert operation["summary"] != operation["operationId"]
    assert operation["summary"] in operation["description"]
    assert ROLES[method, route.path] == role
    assert (operation["security"] == []) == (role is None)
    assert {name for scheme in operation["security"] for name in scheme} <= set(SCHEMES)
    assert "422" not in operation["responses"]
    for status in ("4XX", "5XX"):
        content = operation["responses"][status]["content"]["application/json"]
        assert content["schema"] == {"$ref": "#/components/schemas/Problem"}
        assert content["examples"]
        for code, example in content["examples"].items():
            assert example["value"]["code"] == code
            assert_fits(example["value"], content["schema"])


@pytest.mark.parametrize(
    ("route", "method", "role"), ROUTES, ids=lambda value: str(getattr(value, "path", value))
)
def test_every_example_fits_the_models(route: APIRoute, method: str, role: Role | None) -> None:
    example = EXAMPLES[method, route.path]
    operation = SCHEMA["paths"][route.path][method.lower()]
    body = operation.get("requestBody")
    assert (body is None) == (example.request is None)
    if body:
        assert_fits(example.request, body["content"]["application/json"]["schema"])
    if route.response_model:
        TypeAdapter(route.response_model).validate_json(json.dumps(example.response))
    elif route.status_code == 204:
        assert example.response is None


def test_each_operation_has_a_subject_and_a_name_of_its_own_that_can_be_read() -> None:
    found = [SCHEMA["paths"][route.path][method.lower()] for route, method, _ in ROUTES]
    names = [operation["operationId"] for operation in found]
    assert len(set(names)) == len(names)
    assert {"gatewayStop", "libraryRead", "motionMove", "peopleMe"} <= set(names)
    assert all(name.isalpha() for name in names)
    assert all(operation["operationId"].startswith(operation["tags"][0]) for operation in found)


def test_every_operation_is_in_one_group_and_every_group_says_what_it_holds() -> None:
    groups = {tag["name"]: tag for tag in SCHEMA["tags"]}
    used = [SCHEMA["paths"][route.path][method.lower()]["tags"] for route, method, _ in ROUTES]
    assert {len(names) for names in used} == {1}
    assert {name for names in used for name in names} == set(groups)
    page = docs_page(SCHEMA)
    for name, tag in groups.items():
        assert tag["description"].endswith(".")
        assert f'<h2 id="{name}">{tag["x-displayName"]}</h2><p>' in page
    assert list(groups) == re.findall(r'<h2 id="(\w+)">', page)


def assert_fits(value: Any, schema: dict[str, Any]) -> None:
    errors = list(validator_for(schema | {"components": SCHEMA["components"]}).iter_errors(value))
    assert errors == []


def test_every_code_has_a_status_and_the_sentences_are_of_codes_that_exist() -> None:
    assert set(PROBLEMS) <= set(get_args(ErrorCode))
    assert set(PROBLEMS) <= set(STATUS_OF)


def test_the_page_for_people_shows_every_route_with_its_example() -> None:
    page = docs_page(SCHEMA)
    for route, method, _ in ROUTES:
        assert f"<span>{method.lower()}</span>{route.path}" in page
    assert "&quot;timeMs&quot;: 1500" in page
    assert "409 latched" in page
