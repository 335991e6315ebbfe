//! Connections: so many at a time, each with so much time.

use crate::studio::server::limits::{CONNECTIONS, HEAD};
use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use tokio::net::{TcpListener, TcpStream};
use tokio::task::AbortHandle;

/// Whether a connection has shown the token.
#[derive(Clone, Debug, Default)]
pub(super) struct Trust(Arc<AtomicBool>);

impl Trust {
    /// It has.
    pub(super) fn grant(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

#[derive(Default)]
struct Open(Mutex<VecDeque<(u64, Trust, AbortHandle)>>);

impl Open {
    fn lock(&self) -> std::sync::MutexGuard<'_, VecDeque<(u64, Trust, AbortHandle)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Makes room for one more: of too many, the oldest that nobody knows goes.
    fn make_room(&self) {
        let mut open = self.lock();
        if open.len() < CONNECTIONS {
            return;
        }
        let unknown = open
            .iter()
            .position(|(_, trust, _)| !trust.0.load(Ordering::Relaxed));
        if let Some((_, _, task)) = open.remove(unknown.unwrap_or(0)) {
            task.abort();
        }
    }
}

/// Takes connections until the program ends.
pub(super) async fn serve(listener: TcpListener, router: Router) {
    let open = Arc::new(Open::default());
    for number in 0.. {
        let stream = match listener.accept().await {
            Ok((stream, _)) => stream,
            Err(_) => {
                // Too many files are open, or the other side is gone again.
                tokio::time::sleep(std::time::Duration::from_millis(20)).await;
                continue;
            }
        };
        open.make_room();
        let trust = Trust::default();
        let task = tokio::spawn(connection(stream, router.clone(), trust.clone()));
        open.lock().push_back((number, trust, task.abort_handle()));
        let open = open.clone();
        tokio::spawn(async move {
            // Ended or aborted alike.
            let _ = task.await;
            open.lock().retain(|(other, _, _)| *other != number);
        });
    }
}

async fn connection(stream: TcpStream, router: Router, trust: Trust) {
    // Small messages go at once.
    let _ = stream.set_nodelay(true);
    let router = router.layer(axum::Extension(trust));
    let service = TowerToHyperService::new(router);
    let served = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(HEAD)
        .max_buf_size(64 << 10)
        .max_headers(64)
        .serve_connection(TokioIo::new(stream), service)
        .with_upgrades();
    // What the other side does wrong ends its connection alone.
    let _ = served.await;
}
