// The precision of all floating-point numbers of the shaders.
alias real = f32;
