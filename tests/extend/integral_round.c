static bool is_round(const iso_problem *f)
{
    const double *J = f->p.J;
    return J[0] == J[1] && J[1] == J[2] && iso_effects_are_free(&f->effects) && !iso_effects_have_level(&f->effects);
}

static double omega_square(const iso_problem *f, const double y[], double *size)
{
    (void)f;
    return *size = dot(y, y);
}
