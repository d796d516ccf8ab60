//! Parts of the command line that its own output cannot show.

mod in_order;
mod output;
mod text;
mod walk;
