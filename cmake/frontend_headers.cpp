// Precompiled headers belong to some target: this one.
