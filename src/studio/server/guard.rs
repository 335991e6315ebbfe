//! Who is let in: requests to exactly the address served, from its own pages, with the token
//! where anything is told or changed.
//!
//! Everybody on the machine may get the interface, which holds no secret. All that concerns
//! scenes needs the token, behind `Host`, `Origin` and `Sec-Fetch-Site`. No element of the
//! interface has a style attribute, and nothing that the server writes for it has one: the
//! content security policy would drop it.

use super::files::FILE;
use super::served::Studio;
use super::token::random;
use crate::studio::limits::RUN;
use crate::studio::server::limits::REQUEST;
use axum::body::Body;
use axum::extract::{Request, State};
use axum::http::header::{AUTHORIZATION, HOST, ORIGIN};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use std::sync::Arc;

/// A fresh nonce for the styles of one page.
#[derive(Clone, Debug)]
pub(super) struct Nonce(pub(super) String);

/// Looks at a request before anything else does, and at the answer's headers.
pub(super) async fn guard(
    State(studio): State<Arc<Studio>>,
    mut request: Request,
    next: Next,
) -> Response {
    let nonce = match random() {
        Ok(nonce) => nonce[..32].to_owned(),
        Err(_) => return refused(StatusCode::INTERNAL_SERVER_ERROR),
    };
    let response = match let_in(&studio, &request) {
        Err(status) => refused(status),
        Ok(()) => {
            request.extensions_mut().insert(Nonce(nonce.clone()));
            // Files wait for their runs, and for each other.
            let time = match request.uri().path() {
                FILE => 3 * RUN,
                _ => REQUEST,
            };
            match tokio::time::timeout(time, next.run(request)).await {
                Ok(response) => response,
                Err(_) => refused(StatusCode::REQUEST_TIMEOUT),
            }
        }
    };
    with_headers(response, &nonce)
}

fn let_in(studio: &Studio, request: &Request) -> Result<(), StatusCode> {
    let headers = request.headers();
    let host = single_header(headers, &HOST).ok_or(StatusCode::FORBIDDEN)?;
    let asked = request.uri().authority();
    if host != studio.host() || asked.is_some_and(|asked| asked.as_str() != studio.host()) {
        return Err(StatusCode::FORBIDDEN);
    }
    let path = request.uri().path();
    let changes = ![Method::GET, Method::HEAD].contains(request.method()) || path == "/ws";
    let own = single_header(headers, &ORIGIN).is_some_and(|origin| origin == studio.origin());
    if (changes || headers.contains_key(ORIGIN)) && !own {
        return Err(StatusCode::FORBIDDEN);
    }
    let site = HeaderName::from_static("sec-fetch-site");
    // A page opened from a file or typed by the user comes from nowhere, or from elsewhere
    // without anything that tells: only the pages themselves are given to it.
    let from = headers
        .get(site)
        .map_or("none", |site| site.to_str().unwrap_or("?"));
    if !["none", "same-origin"].contains(&from) && path != "/" {
        return Err(StatusCode::FORBIDDEN);
    }
    if path.starts_with("/api/") {
        let given =
            single_header(headers, &AUTHORIZATION).and_then(|text| text.strip_prefix("Bearer "));
        if !given.is_some_and(|given| studio.token().is(given)) {
            return Err(StatusCode::UNAUTHORIZED);
        }
        if let Some(connection) = request.extensions().get::<super::connections::Trust>() {
            connection.grant();
        }
    }
    Ok(())
}

/// A header that is there once.
fn single_header<'h>(headers: &'h HeaderMap, name: &HeaderName) -> Option<&'h str> {
    let mut all = headers.get_all(name).iter();
    let first = all.next()?;
    all.next().is_none().then_some(first)?.to_str().ok()
}

/// An answer that tells nothing.
pub(super) fn refused(status: StatusCode) -> Response {
    let words = status.canonical_reason().unwrap_or("refused");
    (status, Body::from(format!("{words}\n"))).into_response()
}

fn with_headers(mut response: Response, nonce: &str) -> Response {
    let policy = format!(
        "default-src 'self'; style-src 'self' 'nonce-{nonce}'; img-src 'self' blob: data:; \
         frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
    );
    let fixed = [
        ("x-content-type-options", "nosniff"),
        ("referrer-policy", "no-referrer"),
        ("cross-origin-opener-policy", "same-origin"),
        ("cross-origin-resource-policy", "same-origin"),
        ("cache-control", "no-store"),
    ];
    let headers = response.headers_mut();
    for (name, value) in fixed {
        headers.insert(
            HeaderName::from_static(name),
            HeaderValue::from_static(value),
        );
    }
    if let Ok(policy) = HeaderValue::from_str(&policy) {
        headers.insert(HeaderName::from_static("content-security-policy"), policy);
    }
    response
}
