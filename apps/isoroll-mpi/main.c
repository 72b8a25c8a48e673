/* main.c - the program isoroll-mpi: the command sweep of isoroll on the ranks of MPI. */
#include <stdio.h>
#include <string.h>

#include "command.h"
#include "ranks.h"

static ranks all; /* the command's `run` has no other way to it */

extern const command command_sweep;

static int run(iso_context *ctx, const void *options)
{
    return sweep_with(ctx, options, &all.team);
}

static void help(FILE *to)
{
    fputs("usage: mpirun -n RANKS isoroll-mpi sweep [options] SWEEP -o FILE\n"
          "measure many orbits or balls, on the ranks of MPI; the result is that of 'isoroll sweep', to the byte\n\n"
          "  isoroll-mpi sweep --help     the options, those of 'isoroll sweep'; -j N: threads of each rank\n"
          "  isoroll-mpi --version        the versions of isoroll and its libraries\n\n"
          "If a rank dies, MPI ends the job. --resume goes on, with any number of ranks.\n",
          to);
}

static int words_or_work(int argc, char **argv)
{
    const char *name = argc > 1 ? argv[1] : "";
    command c = command_sweep;
    c.run = run;
    if (strcmp(name, "sweep") == 0) return program_run(&c, argc - 1, argv + 1);
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0)
        return help(stdout), EXIT_DONE;
    if (strcmp(name, "--version") == 0) return program_version(), EXIT_DONE;
    if (argc < 2)
        help(stderr);
    else
        warn("isoroll-mpi has the command 'sweep' alone, not '%s'", name);
    return EXIT_USAGE;
}

/* Rank 0 prints. If it has no trouble, another rank may print its own. The job has the exit status of rank 0. */
int main(int argc, char **argv)
{
    int threads;
    program_begin();
    stop_gently(); /* before MPI: a signal that comes early counts as well */
    MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &threads);
    ranks_begin(&all);
    if (all.rank > 0) {
        warn_silently();
        (void)!freopen("/dev/null", "w", stdout);
    }
    int result = EXIT_USAGE;
    if (threads < MPI_THREAD_SERIALIZED)
        warn("this MPI does not let threads call it (MPI_THREAD_SERIALIZED): build it with threads");
    else if (all.rank == 0 || argc > 2)
        result = words_or_work(argc, argv);
    else
        result = EXIT_DONE; /* rank 0 prints what was asked for */
    result = program_flush(result);
    if (!all.agreed) result = all.team.agree(&all, result); /* others may wait for the answer of this rank */
    ranks_meet(&all);
    MPI_Finalize();
    return all.rank == 0 ? result : EXIT_DONE;
}
