//! What ARIA lets be: the role of each thing, what a container may have in it, and what has to stand in one.

use egui::accesskit::Role;

use super::record::{MirrorId, MirrorNode};

/// A record with those inside of it.
pub struct Branch {
    pub node: MirrorNode,
    pub children: Vec<Branch>,
}

/// Whether it is a control that is pressed as a whole.
pub(super) fn is_pressed(role: &str) -> bool {
    matches!(role, "button" | "checkbox" | "switch" | "radio" | "tab" | "link")
}

/// Whether it lies over the rest while it is open.
pub(super) fn is_overlay(branch: &Branch) -> bool {
    matches!(branch.node.role, "dialog" | "alertdialog" | "menu" | "listbox")
}

/// The first title or words among these.
pub(super) fn first_words(branches: &[Branch]) -> String {
    let words = branches
        .iter()
        .find(|branch| matches!(branch.node.role, "heading" | "text"));
    words.map_or_else(|| "Choices".to_owned(), |branch| branch.node.name.clone())
}

pub(super) fn around(branches: &[Branch]) -> [f32; 4] {
    let rects = branches.iter().map(|branch| branch.node.bounds);
    let corners = rects.map(|[x, y, width, height]| [x, y, x + width, y + height]);
    let all = corners.reduce(|a, b| [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]);
    all.map_or([0.0; 4], |[x0, y0, x1, y1]| [x0, y0, x1 - x0, y1 - y0])
}

/// The role of ARIA, `text` for words alone. None for what says nothing by itself.
pub(super) fn role_of(role: Role, named: bool, clickable: bool) -> Option<&'static str> {
    Some(match role {
        Role::Button | Role::DefaultButton | Role::ColorWell | Role::DisclosureTriangle | Role::ComboBox => "button",
        Role::CheckBox => "checkbox",
        Role::Switch => "switch",
        Role::RadioButton => "radio",
        Role::Slider => "slider",
        Role::SpinButton | Role::NumberInput => "spinbutton",
        Role::Splitter | Role::ScrollBar => return None,
        Role::TextInput | Role::SearchInput | Role::MultilineTextInput => "textbox",
        Role::Link => "link",
        Role::Heading => "heading",
        Role::Tab => "tab",
        Role::TabList => "tablist",
        Role::TabPanel if named => "tabpanel",
        Role::Tree | Role::TreeGrid => "tree",
        Role::TreeItem => "treeitem",
        Role::List => "list",
        Role::ListItem | Role::ListBoxOption | Role::MenuListOption if clickable => "option",
        Role::ListItem => "listitem",
        Role::ListBox => "listbox",
        Role::Menu | Role::MenuListPopup => "menu",
        Role::MenuBar => "menubar",
        Role::MenuItem => "menuitem",
        Role::MenuItemCheckBox => "menuitemcheckbox",
        Role::MenuItemRadio => "menuitemradio",
        Role::Grid | Role::Table => "grid",
        Role::Row => "row",
        Role::Cell | Role::GridCell => "gridcell",
        Role::ColumnHeader => "columnheader",
        Role::RowHeader => "rowheader",
        Role::Dialog => "dialog",
        Role::AlertDialog => "alertdialog",
        Role::Alert => "alert",
        Role::Status => "status",
        Role::Toolbar if named => "toolbar",
        Role::RadioGroup => "radiogroup",
        Role::ProgressIndicator => "progressbar",
        Role::Tooltip => return None,
        Role::TextRun => return None,
        _ if !named => return None,
        Role::Label | Role::Paragraph => "text",
        Role::Image | Role::Canvas | Role::Figure => "img",
        Role::Region | Role::Pane | Role::Complementary | Role::Navigation | Role::Form | Role::Section => "region",
        _ if clickable => "button",
        _ => "group",
    })
}

/// Whether it is a row without cells, to be read and not to be used.
fn is_line(branch: &Branch) -> bool {
    branch.node.role == "row" && branch.children.is_empty() && !branch.node.focusable && !branch.node.clickable
}

/// What ARIA lets a container have in it; None for what may have anything.
pub(super) fn items_of(container: &str) -> Option<&'static [&'static str]> {
    Some(match container {
        "tree" => &["treeitem"],
        "listbox" => &["option"],
        "list" => &["listitem"],
        "tablist" => &["tab"],
        "menu" | "menubar" => &["menuitem", "menuitemcheckbox", "menuitemradio", "separator"],
        "grid" => &["row"],
        "row" => &["gridcell", "columnheader", "rowheader"],
        _ => return None,
    })
}

/// Makes the items of a container what ARIA expects there. A container with anything else in it is a group.
pub fn settle(branch: &mut Branch) {
    let Some(items) = items_of(branch.node.role) else {
        branch.children = among_others(branch.node.id, std::mem::take(&mut branch.children));
        return;
    };
    if branch.node.role == "row" && branch.children.is_empty() {
        return;
    }
    if branch.node.role == "grid" && !branch.children.is_empty() && branch.children.iter().all(is_line) {
        // A table whose rows are read as a whole.
        (branch.node.role, branch.node.of) = ("list", None);
        for child in &mut branch.children {
            child.node.role = "listitem";
        }
        return;
    }
    let container = branch.node.role;
    branch.children = adopted(std::mem::take(&mut branch.children));
    let as_item = |child: &Branch| match (container, child.node.role) {
        (_, role) if items.contains(&role) => Some(role),
        _ if !child.children.is_empty() => None,
        ("listbox", "button" | "radio") => Some("option"),
        ("tablist", "button" | "radio") => Some("tab"),
        ("menu" | "menubar", "button") if child.node.on.is_none() => Some("menuitem"),
        ("menu" | "menubar", "button" | "radio" | "option") => Some("menuitemradio"),
        ("menu" | "menubar", "checkbox" | "switch") => Some("menuitemcheckbox"),
        // Focus goes from item to item, so that a title between them is never read as a heading.
        ("menu" | "menubar", "heading") => Some("separator"),
        ("list", "text") => Some("listitem"),
        _ => None,
    };
    let roles: Option<Vec<_>> = branch.children.iter().map(as_item).collect();
    match roles {
        Some(roles) if !roles.is_empty() => {
            for (child, role) in branch.children.iter_mut().zip(roles) {
                child.node.role = role;
                if role == "menuitem" {
                    // It does something, and is nothing that is chosen.
                    child.node.on = None;
                }
            }
        }
        _ => {
            branch.node.role = if is_overlay(branch) { "dialog" } else { "group" };
            branch.children = among_others(branch.node.id, std::mem::take(&mut branch.children));
        }
    }
}

/// Items that stand among other things: rows of a tree and tabs get the container that they lack, others are what they would be alone.
pub(super) fn among_others(parent: MirrorId, children: Vec<Branch>) -> Vec<Branch> {
    let mut kept: Vec<Branch> = Vec::with_capacity(children.len());
    for mut child in adopted(children) {
        let container = match child.node.role {
            "treeitem" => Some("tree"),
            "tab" => Some("tablist"),
            _ => None,
        };
        if let Some(role) = container {
            match kept
                .last_mut()
                .filter(|last| last.node.role == role && last.node.id == parent.around(role))
            {
                Some(last) => last.children.push(child),
                None => kept.push(container_around(parent.around(role), role, child)),
            }
            continue;
        }
        child.node.role = match child.node.role {
            "option" | "menuitem" | "menuitemcheckbox" | "menuitemradio" => "button",
            "listitem" | "gridcell" | "columnheader" | "rowheader" if child.children.is_empty() => "text",
            "listitem" | "gridcell" | "columnheader" | "rowheader" | "row" => "group",
            role => role,
        };
        kept.push(child);
    }
    for container in kept
        .iter_mut()
        .filter(|branch| branch.node.id == parent.around(branch.node.role))
    {
        container.node.bounds = around(&container.children);
    }
    kept
}

/// Buttons that lie on a row of a tree belong to the row.
fn adopted(children: Vec<Branch>) -> Vec<Branch> {
    let mut kept: Vec<Branch> = Vec::with_capacity(children.len());
    for child in children {
        let row = kept
            .last_mut()
            .filter(|row| row.node.role == "treeitem" && child.node.role != "treeitem");
        match row.filter(|row| lies_on(child.node.bounds, row.node.bounds)) {
            Some(row) => row.children.push(child),
            None => kept.push(child),
        }
    }
    kept
}

fn lies_on([x, y, width, height]: [f32; 4], row: [f32; 4]) -> bool {
    let center = [x + 0.5 * width, y + 0.5 * height];
    (0..2).all(|axis| (row[axis]..=row[axis] + row[axis + 2]).contains(&center[axis]))
}

fn container_around(id: MirrorId, role: &'static str, child: Branch) -> Branch {
    let node = MirrorNode {
        id,
        role,
        stop: true,
        bounds: child.node.bounds,
        ..MirrorNode::default()
    };
    Branch {
        node,
        children: vec![child],
    }
}
