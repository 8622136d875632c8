// The precision of all floating-point numbers.
alias real = f32;
