// The stress of a body by its law.
#import st_venant_kirchhoff

fn first_piola(body: Body, h: Mat, memory: Sym) -> Mat {
    return first_piola_st_venant_kirchhoff(body, h);
}
