//! What a host is to say of each file of the site: `_headers`, as Netlify and Cloudflare Pages read it.
//!
//! A host that reads no such file serves a page that works: its policy is in `index.html` too, and names have hashes.

use std::collections::BTreeMap;

use crate::site::{CONTENT_SECURITY_POLICY, FRAME_ANCESTORS, media_type};
use crate::sizes::is_hashed;

/// The file's name.
pub(crate) const NAME: &str = "_headers";

/// The same for who has another host.
pub(crate) const ADVICE: &str = "\
dist/ is complete: any folder of any host over HTTPS will do. Netlify and Cloudflare Pages read its _headers; of another host
  - names with a hash may be kept for ever:        Cache-Control: public, max-age=31536000, immutable
  - pages, sw.js and the manifest are asked for:   Cache-Control: no-cache
  - .wasm is application/wasm, and .m3d is text, which hosts compress; .br and .gz lie beside each file
  - pages of other sites take the element with:     Access-Control-Allow-Origin: *
  - who may frame the page only a header can say:  Content-Security-Policy: frame-ancestors *";

/// Its text. Where two rules hold, these hosts join their values, so each field is in one of them.
pub(crate) fn made(files: &BTreeMap<String, Vec<u8>>) -> String {
    let mut text = format!(
        "/*\n  Content-Security-Policy: {CONTENT_SECURITY_POLICY}; {FRAME_ANCESTORS}\n  X-Content-Type-Options: nosniff\n  \
         Referrer-Policy: no-referrer\n  Access-Control-Allow-Origin: *\n"
    );
    let page = ("".to_owned(), "index.html");
    let all = files.keys().map(|name| (name.clone(), name.as_str()));
    for (address, name) in std::iter::once(page).chain(all) {
        let kept = if is_hashed(name) {
            "public, max-age=31536000, immutable"
        } else {
            "no-cache"
        };
        text.push_str(&format!(
            "/{address}\n  Content-Type: {}\n  Cache-Control: {kept}\n",
            media_type(name)
        ));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dist;

    #[test]
    fn each_file_has_one_rule_and_only_names_with_a_hash_are_kept_for_ever() {
        let files = dist::of_the_page();
        let text = made(&files);
        let rule = |address: &str| {
            let (_, rest) = text.split_once(&format!("\n/{address}\n")).expect(address);
            rest.lines()
                .take_while(|line| line.starts_with("  "))
                .map(str::trim)
                .collect::<Vec<_>>()
        };
        for asked in [
            "",
            "index.html",
            "web/codes.html",
            "licenses.txt",
            "web/element/bindpose-viewer.js",
            "sw.js",
            "web/bindpose.webmanifest",
        ] {
            assert_eq!(rule(asked)[1], "Cache-Control: no-cache", "{asked}");
        }
        assert_eq!(rule("sw.js")[0], "Content-Type: text/javascript; charset=utf-8");
        let mut hashed = 0;
        for name in files.keys().filter(|name| is_hashed(name)) {
            assert_eq!(rule(name)[1], "Cache-Control: public, max-age=31536000, immutable");
            if name.ends_with(".wasm") {
                assert_eq!(rule(name)[0], "Content-Type: application/wasm");
            }
            hashed += 1;
        }
        assert_eq!(hashed + 6, files.len());
        assert!(text.starts_with("/*\n  Content-Security-Policy: default-src 'self'; "));
        assert!(text.contains("; form-action 'none'; frame-ancestors *\n"));
    }
}
