/* hill_impl.h - Hill's equation of a rotation by Taylor series, in numbers of the type NUMBER; see hill.c. On the
 * level H = E, with eps = 1 and u = E q^(1+1/k):
 *
 *     (q + u) y'' = (q'/(2k)) y' - ((1/k) (J_i - (1-k) q) + u) y, q = m + d cos 2 phi = J_a cos^2 phi + J_b sin^2 phi
 *     q u' = (1 + 1/k) q' u
 *
 * The singular points are the zeros of q: cos 2 phi = -m/d, at phi = pi/2 (d > 0) or 0 (d < 0), up to i b,
 * cosh 2b = m/|d|; and those of 1 + E q^(1/k). Each step is a fixed part of the distance to them, and has as many
 * terms as the digits need.
 */
typedef struct HILL(problem) {
    NUMBER k, Ji, m, d, energy;
} HILL(problem);

/* The series of c = d cos 2 phi, s = d sin 2 phi and u about phi, in powers of h:
 *
 *     n q u_n = sum_{j = 1..n} ((1 + 1/k) j - (n - j)) c_j u_{n-j}
 */
static void HILL(series)(const HILL(problem) * p, NUMBER phi, NUMBER c[], NUMBER s[], NUMBER u[], int order)
{
    c[0] = p->d * COS(2 * phi);
    s[0] = p->d * SIN(2 * phi);
    const NUMBER q = p->m + c[0], power = 1 + 1 / p->k;
    u[0] = p->energy * q * POW(q, 1 / p->k);
    for (int n = 1; n <= order; n++) {
        c[n] = -2 * s[n - 1] / n;
        s[n] = 2 * c[n - 1] / n;
        u[n] = 0;
        for (int j = 1; j <= n && p->energy != 0; j++) u[n] += (power * j - (n - j)) * c[j] * u[n - j];
        u[n] /= n * q;
    }
}

/* One step of the matrix whose columns are two solutions (y, y'). q = m + c, q' = -2 s. The coefficient of h^n:
 *
 *     m (n+2)(n+1) y_{n+2} = sum_{j <= n} [ -(c_j + u_j) (n-j+2)(n-j+1) y_{n-j+2} - (s_j/k) (n-j+1) y_{n-j+1}
 *                                           + (((1-k)/k) c_j - u_j) y_{n-j} ] - (1/k)(J_i - (1-k) m) y_n
 */
static void HILL(step)(const HILL(problem) * p, NUMBER phi, NUMBER h, NUMBER y[2][2])
{
    NUMBER c[TERMS + 3], s[TERMS + 3], u[TERMS + 3], a[TERMS + 3];
    HILL(series)(p, phi, c, s, u, TERMS);
    const NUMBER q = p->m + c[0] + u[0], keep = (1 - p->k) / p->k, pull = (p->Ji - (1 - p->k) * p->m) / p->k;
    for (int column = 0; column < 2; column++) {
        a[0] = y[0][column];
        a[1] = y[1][column];
        for (int n = 0; n <= TERMS - 2; n++) {
            NUMBER sum = -pull * a[n];
            for (int j = 0; j <= n; j++) {
                const int r = n - j;
                if (j > 0) sum -= (c[j] + u[j]) * (NUMBER)((r + 2) * (r + 1)) * a[r + 2];
                sum += (keep * c[j] - u[j]) * a[r] - s[j] * (NUMBER)(r + 1) / p->k * a[r + 1];
            }
            a[n + 2] = sum / (q * (NUMBER)((n + 2) * (n + 1)));
        }
        NUMBER value = 0, slope = 0;
        for (int n = TERMS; n > 0; n--) value = value * h + a[n], slope = slope * h + (NUMBER)n * a[n];
        y[0][column] = value * h + a[0];
        y[1][column] = slope;
    }
}

/* The matrix from phi = 0 to pi. */
static void HILL(turn)(NUMBER k, NUMBER Ji, NUMBER Ja, NUMBER Jb, NUMBER energy, NUMBER y[2][2])
{
    const HILL(problem) p = {k, Ji, (Ja + Jb) / 2, (Ja - Jb) / 2, energy};
    const double ratio = (double)(p.m / (p.d < 0 ? -p.d : p.d)), swing = (double)(Ji / (Ja < Jb ? Ja : Jb) / k);
    const hill_pace pace = pace_of((double)k, (double)p.m, (double)p.d, (double)energy, ratio, swing);
    NUMBER phi = 0;
    y[0][0] = y[1][1] = 1;
    y[0][1] = y[1][0] = 0;
    while (phi < PI) {
        const double h = step_from(&pace, (double)phi);
        const bool last = (NUMBER)h >= PI - phi;
        const NUMBER length = last ? PI - phi : (NUMBER)h;
        HILL(step)(&p, phi, length, y);
        phi = last ? PI : phi + length;
    }
}
