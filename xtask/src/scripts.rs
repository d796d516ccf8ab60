//! Scripts as they are shipped: without what only their readers need.

/// A script without the comments that begin a line, without empty lines and without indentation, outside of templates (between
/// backquotes). What stands behind code on its line stays: to see whether that is a comment one has to read the language.
pub(crate) fn without_comments(script: &str) -> String {
    let mut kept = String::with_capacity(script.len());
    let (mut in_comment, mut in_template) = (false, false);
    for line in script.lines() {
        let mut code = line;
        if !in_template {
            code = behind_comments(line.trim(), &mut in_comment);
            if code.is_empty() || code.starts_with("//") {
                continue;
            }
        }
        kept.push_str(code);
        kept.push('\n');
        in_template ^= opens_or_closes_template(code);
    }
    kept
}

/// What stands on a line behind the comments at its beginning; `in_comment` says whether one goes on there, and then whether one goes on
/// behind the line.
fn behind_comments<'a>(mut line: &'a str, in_comment: &mut bool) -> &'a str {
    loop {
        if *in_comment {
            let Some((_, behind)) = line.split_once("*/") else {
                return "";
            };
            (line, *in_comment) = (behind.trim_start(), false);
        }
        let Some(comment) = line.strip_prefix("/*") else {
            return line;
        };
        (line, *in_comment) = (comment, true);
    }
}

/// Whether a template that begins on a line goes on behind it, or one that went on ends.
fn opens_or_closes_template(line: &str) -> bool {
    let backquotes = line.matches('`').count() - line.matches("\\`").count();
    !backquotes.is_multiple_of(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dist;

    #[test]
    fn comments_and_indentation_go_and_the_rest_stays() {
        let script = "\
/** Says `hello`.
 * Twice. */
export function f(a) {
  // A comment.
  const b = a / 2; // behind code

  /* one line */
  return `
    // no comment, ${b}
    /* nor this */
  ` + b
    * 3;
}
/* `with code */ f(1); /* and behind it */
/* begins
 ends */ f(2);
f(3);
";
        assert_eq!(
            without_comments(script),
            "\
export function f(a) {
const b = a / 2; // behind code
return `
    // no comment, ${b}
    /* nor this */
  ` + b
* 3;
}
f(1); /* and behind it */
f(2);
f(3);
"
        );
    }

    /// Where this fails, the end of a comment was not seen, or that of a template.
    #[test]
    fn of_the_pages_scripts_the_last_line_stays() {
        let page = dist::page();
        let scripts: Vec<_> = page
            .iter()
            .filter(|(address, _)| address.starts_with("web/") && address.ends_with(".js"))
            .collect();
        assert!(scripts.len() > 20, "{}", scripts.len());
        for (address, bytes) in scripts {
            let script = std::str::from_utf8(bytes).expect("text");
            let kept = without_comments(script);
            assert_eq!(
                kept.lines().last().map(str::trim),
                script.lines().last().map(str::trim),
                "{address}"
            );
            assert!(!kept.contains("/**") && !kept.contains("\n//"), "{address}");
        }
    }
}
