"""Headers of every response; web pages elsewhere see errors too."""

import pytest

from tests.service.conftest import MakeService, Service
from tests.service.test_auth import bearer

ORIGIN = "https://maps.example"


@pytest.mark.parametrize("path", ["/", "/healthz", "/sparql", "/nothing", "/openapi.json"])
def test_security_headers(service: Service, path: str) -> None:
    headers = service.client.get(path).headers
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["referrer-policy"] == "no-referrer"
    is_page = headers["content-type"].startswith("text/html")
    assert is_page == (path == "/")
    assert ("content-security-policy" in headers) == is_page
    if is_page:
        assert "default-src 'self'" in headers["content-security-policy"]


def test_a_page_may_have_a_policy_of_its_own(make_service: MakeService) -> None:
    from fastapi.responses import HTMLResponse

    service = make_service()

    async def page() -> HTMLResponse:
        return HTMLResponse("", headers={"Content-Security-Policy": "default-src 'none'"})

    service.app.add_api_route("/page", page)
    found = service.client.get("/page").headers.get_list("content-security-policy")
    assert found == ["default-src 'none'"]


def test_web_pages_elsewhere_see_errors(service: Service) -> None:
    for headers, status in (({}, 401), (bearer("wrong"), 401)):
        response = service.client.delete("/graphs?default", headers={**headers, "Origin": ORIGIN})
        assert response.status_code == status
        assert response.headers["access-control-allow-origin"] == ORIGIN
        exposed = set(response.headers["access-control-expose-headers"].split(", "))
        assert {"WWW-Authenticate", "X-Request-ID", "Retry-After"} <= exposed


def test_web_pages_elsewhere_may_send_tokens(make_service: MakeService) -> None:
    service = make_service(cors_origins=ORIGIN, public_read=False)
    asked = service.client.options(
        "/graphs?default",
        headers={
            "Origin": ORIGIN, "Access-Control-Request-Method": "PUT",
            "Access-Control-Request-Headers": "authorization, content-type, x-request-id",
        },
    )  # fmt: skip
    assert asked.status_code == 200
    allowed = asked.headers["access-control-allow-headers"].lower()
    assert "authorization" in allowed
    assert "PUT" in asked.headers["access-control-allow-methods"]


def test_not_ready_without_workers(make_service: MakeService) -> None:
    import os
    import signal

    service = make_service(workers=1)
    assert service.client.get("/readyz").json() == {"status": "ready"}
    (worker,) = service.app.state.store.workers
    os.kill(worker, signal.SIGKILL)
    while service.client.get("/readyz").status_code == 200:
        pass
    response = service.client.get("/readyz")
    assert response.status_code == 503
    assert response.json()["type"].endswith("#not-ready")
    assert service.client.get("/healthz").status_code == 200
