//! `dam` as WebAssembly, for the studio in a browser tab.
//!
//! The page writes a request, UTF-8, to where [`room`] says and calls [`ask`]; while that lasts it
//! is told what is found by the functions that it lends. Nothing else crosses the border.

#![allow(unsafe_code)] // what a page calls, and what it lends, is declared so

use dam::studio::tab::{Tab, Told};
use std::cell::RefCell;

#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// A message, as JSON.
    safe fn text(at: *const u8, length: usize);
    /// An answer with its numbers.
    safe fn answer(at: *const u8, length: usize);
    /// What went wrong in the program itself; nothing comes after it.
    safe fn failed(at: *const u8, length: usize);
}

thread_local! {
    static TAB: RefCell<Tab> = RefCell::new(dam::cli::tab());
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Where a request of so many bytes is to be written.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    REQUEST.with_borrow_mut(|request| {
        request.clear();
        request.resize(length, 0);
        request.as_mut_ptr()
    })
}

/// Answers the request that was written.
#[unsafe(no_mangle)]
pub extern "C" fn ask() {
    std::panic::set_hook(Box::new(|told| {
        let told = told.to_string();
        failed(told.as_ptr(), told.len());
    }));
    let request = REQUEST.with_borrow_mut(std::mem::take);
    let request = String::from_utf8_lossy(&request);
    let wrong = TAB.with_borrow_mut(|tab| tab.ask(&request, &tell)).err();
    if let Some(wrong) = wrong {
        failed(wrong.as_ptr(), wrong.len());
    }
}

fn tell(told: Told) {
    match told {
        Told::Text(words) => text(words.as_ptr(), words.len()),
        Told::Answer(bytes) => answer(bytes.as_ptr(), bytes.len()),
    }
}
