/* hill_impl.h - Hill's equation of a rotation by Taylor series, in numbers of the type NUMBER; see hill.c.
 *
 *     q y'' = (q'/(2k)) y' - (1/k) (J_i - (1-k) q) y,       q = m + d cos 2 phi = J_a cos^2 phi + J_b sin^2 phi
 *
 * The only singular points are the zeros of q: cos 2 phi = -m/d, at phi = pi/2 (d > 0) or 0 (d < 0), up to i b,
 * cosh 2b = m/|d|. Each step is a fixed part of the distance to them, and has as many terms as the digits need.
 */
typedef struct HILL(problem) {
    NUMBER k, Ji, m, d;
} HILL(problem);

/* The series of cos 2 phi and sin 2 phi times d about phi, in powers of h. */
static void HILL(circle)(const HILL(problem) * p, NUMBER phi, NUMBER cosine[], NUMBER sine[], int order)
{
    cosine[0] = p->d * COS(2 * phi);
    sine[0] = p->d * SIN(2 * phi);
    for (int n = 1; n <= order; n++) {
        cosine[n] = -2 * sine[n - 1] / n;
        sine[n] = 2 * cosine[n - 1] / n;
    }
}

/* One step of the matrix whose columns are two solutions (y, y'). q = m + c, q' = -2 s. The coefficient of h^n:
 *
 *     m (n+2)(n+1) y_{n+2} = sum_{j <= n} [ -c_j (n-j+2)(n-j+1) y_{n-j+2} - (s_j/k) (n-j+1) y_{n-j+1}
 *                                           + ((1-k)/k) c_j y_{n-j} ] - (1/k)(J_i - (1-k) m) y_n
 */
static void HILL(step)(const HILL(problem) * p, NUMBER phi, NUMBER h, NUMBER y[2][2])
{
    NUMBER c[TERMS + 3], s[TERMS + 3], a[TERMS + 3];
    HILL(circle)(p, phi, c, s, TERMS);
    const NUMBER q = p->m + c[0], keep = (1 - p->k) / p->k, pull = (p->Ji - (1 - p->k) * p->m) / p->k;
    for (int column = 0; column < 2; column++) {
        a[0] = y[0][column];
        a[1] = y[1][column];
        for (int n = 0; n <= TERMS - 2; n++) {
            NUMBER sum = -pull * a[n];
            for (int j = 0; j <= n; j++) {
                const int r = n - j;
                if (j > 0) sum -= c[j] * (NUMBER)((r + 2) * (r + 1)) * a[r + 2];
                sum += keep * c[j] * a[r] - s[j] * (NUMBER)(r + 1) / p->k * a[r + 1];
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
static void HILL(turn)(NUMBER k, NUMBER Ji, NUMBER Ja, NUMBER Jb, NUMBER y[2][2])
{
    const HILL(problem) p = {k, Ji, (Ja + Jb) / 2, (Ja - Jb) / 2};
    const double ratio = (double)(p.m / (p.d < 0 ? -p.d : p.d));
    const double height = Ja == Jb ? 1e3 : acosh(ratio) / 2, middle = Ja > Jb ? ISO_PI / 2 : 0;
    NUMBER phi = 0;
    y[0][0] = y[1][1] = 1;
    y[0][1] = y[1][0] = 0;
    while (phi < PI) {
        double apart = fabs((double)phi - middle);
        if (middle == 0) apart = fmin(apart, ISO_PI - (double)phi);
        double h = PART * hypot(apart, height);
        const double pace = sqrt(fabs((double)(Ji / (Ja < Jb ? Ja : Jb) / k)) + 1); /* of y, at most */
        h = fmin(h, 1 / (1 + pace));
        const bool last = (NUMBER)h >= PI - phi;
        const NUMBER length = last ? PI - phi : (NUMBER)h;
        HILL(step)(&p, phi, length, y);
        phi = last ? PI : phi + length;
    }
}
