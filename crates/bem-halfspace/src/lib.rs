//! bem-halfspace
