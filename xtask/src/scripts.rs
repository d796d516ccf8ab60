//! Scripts as they are shipped: without what only their readers need.

/// A script without the lines that are comments alone, without empty lines and without indentation, outside of templates (between
/// backquotes). What stands behind code on its line stays: to see whether that is a comment one has to read the language.
pub(crate) fn without_comments(script: &str) -> String {
    let mut kept = String::with_capacity(script.len());
    let (mut in_comment, mut in_template) = (false, false);
    for line in script.lines() {
        let text = line.trim();
        let begins_comment = text.starts_with("/*") && (text.ends_with("*/") || !text.contains("*/"));
        if in_template {
            kept.push_str(line);
        } else if in_comment || begins_comment {
            in_comment = !text.ends_with("*/");
            continue;
        } else if text.is_empty() || text.starts_with("//") {
            continue;
        } else {
            kept.push_str(text);
        }
        kept.push('\n');
        in_template ^= opens_or_closes_template(line);
    }
    kept
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
/* with code */ f(1);
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
/* with code */ f(1);
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
