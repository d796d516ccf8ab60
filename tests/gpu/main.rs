//! What needs a GPU: drawn on the software adapters of Vulkan and GL alike.
