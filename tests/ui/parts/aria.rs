//! What ARIA lets be.

use bindpose::ui::for_tests::{Branch, settle_roles};
use bindpose::ui::{MirrorId, MirrorNode};

/// A thing without anything in it, which lies on the row at this height.
fn leaf(id: u64, role: &'static str, y: f32) -> Branch {
    let node = MirrorNode {
        id: MirrorId::from_text(&id.to_string()).expect("a number"),
        role,
        bounds: [0.0, y, 100.0, 20.0],
        ..MirrorNode::default()
    };
    Branch {
        node,
        children: Vec::new(),
    }
}

fn container(role: &'static str, children: Vec<Branch>) -> Branch {
    let mut branch = leaf(0, role, 0.0);
    branch.children = children;
    settle_roles(&mut branch);
    branch
}

/// Roles from the outside inwards: `list(listitem listitem)`.
fn roles(branch: &Branch) -> String {
    let inner: Vec<_> = branch.children.iter().map(roles).collect();
    if inner.is_empty() {
        return branch.node.role.to_owned();
    }
    format!("{}({})", branch.node.role, inner.join(" "))
}

#[test]
fn items_become_what_their_container_needs() {
    for (role, child, expected) in [
        ("listbox", "button", "listbox(option)"),
        ("tablist", "radio", "tablist(tab)"),
        ("menu", "button", "menu(menuitem)"),
        ("menu", "switch", "menu(menuitemcheckbox)"),
        ("menu", "heading", "menu(separator)"),
        ("list", "text", "list(listitem)"),
        ("tree", "treeitem", "tree(treeitem)"),
    ] {
        assert_eq!(roles(&container(role, vec![leaf(1, child, 0.0)])), expected);
    }
}

#[test]
fn a_line_of_a_menu_that_is_on_is_chosen() {
    let mut on = leaf(1, "button", 0.0);
    on.node.on = Some("true");
    assert_eq!(roles(&container("menu", vec![on])), "menu(menuitemradio)");
}

#[test]
fn a_container_with_anything_else_in_it_is_a_group_and_one_that_opens_a_dialog() {
    let mixed = || vec![leaf(1, "option", 0.0), leaf(2, "slider", 30.0)];
    assert_eq!(roles(&container("list", mixed())), "group(button slider)");
    assert_eq!(roles(&container("menu", mixed())), "dialog(button slider)");
    assert_eq!(roles(&container("list", Vec::new())), "group", "and so is an empty one");
}

#[test]
fn a_table_whose_rows_are_read_as_a_whole_is_a_list() {
    let lines = vec![leaf(1, "row", 0.0), leaf(2, "row", 30.0)];
    assert_eq!(roles(&container("grid", lines)), "list(listitem listitem)");
    let mut used = leaf(1, "row", 0.0);
    used.node.clickable = true;
    assert_eq!(
        roles(&container("grid", vec![used])),
        "grid(row)",
        "one that is pressed stays a row"
    );
    let row = container("row", vec![leaf(2, "rowheader", 0.0), leaf(3, "gridcell", 0.0)]);
    assert_eq!(roles(&container("grid", vec![row])), "grid(row(rowheader gridcell))");
}

#[test]
fn rows_among_other_things_get_a_tree_with_the_buttons_that_lie_on_them() {
    let children = vec![
        leaf(1, "textbox", 0.0),
        leaf(2, "treeitem", 30.0),
        leaf(3, "button", 30.0),
        leaf(4, "treeitem", 60.0),
        leaf(5, "button", 90.0),
    ];
    let panel = container("group", children);
    assert_eq!(roles(&panel), "group(textbox tree(treeitem(button) treeitem) button)");
    let tree = &panel.children[1].node;
    assert_eq!(tree.bounds, [0.0, 30.0, 100.0, 50.0], "around its rows");
    assert_ne!(tree.id, panel.node.id);
}

#[test]
fn items_without_a_container_are_what_they_would_be_alone() {
    let children = vec![leaf(1, "menuitemradio", 0.0), leaf(2, "listitem", 30.0)];
    assert_eq!(roles(&container("group", children)), "group(button text)");
}
