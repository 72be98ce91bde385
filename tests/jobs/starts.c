/* starts.c - preloaded into sph or fv by tests/jobs/lib.py: one process that has called MPI_Init
 * makes many runs of the program. To link and to start MPI takes ten times what a small scene does.
 * Each line of the standard input is a run, fields divided by tabs: folder, file of what it says,
 * arguments. A child takes the place of the program that called MPI_Init with these arguments; its
 * exit code goes to the standard output, 128 and more for a signal. One rank: nothing is sent, so a
 * child may go on with its parent's MPI. SPDX-License-Identifier: BSD-3-Clause */
#include <fcntl.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { LINE_BYTES = 65536, ARGS = 256, LONGEST = 240 /* s of processor time of a run */ };

/* In the child: the folder, the file and the arguments of a line. */
static void become(char *line, int *argc, char ***argv)
{
    static char *args[ARGS];
    const struct rlimit longest = {LONGEST, LONGEST};
    int n = 1;
    const char *folder = strtok(line, "\t"), *said = strtok(NULL, "\t");
    const int out = chdir(folder) == 0 ? open(said, O_WRONLY | O_CREAT | O_TRUNC, 0666) : -1;
    const int in = open("/dev/null", O_RDONLY);
    if (out < 0 || dup2(out, 1) < 0 || dup2(out, 2) < 0 || dup2(in, 0) < 0)
        _exit(126);
    close(out);
    close(in);
    setrlimit(RLIMIT_CPU, &longest);
    args[0] = (*argv)[0];
    for (char *a; n < ARGS - 1 && (a = strtok(NULL, "\t"));)
        args[n++] = a;
    args[n] = NULL;
    *argc = n;
    *argv = args;
}

static int wait_for(pid_t child)
{
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int MPI_Init(int *argc, char ***argv)
{
    static char line[LINE_BYTES];
    const int code = PMPI_Init(argc, argv);
    unsetenv("LD_PRELOAD");
    while (fgets(line, sizeof line, stdin)) {
        line[strcspn(line, "\n")] = '\0';
        const pid_t child = fork();
        if (child == 0) {
            become(line, argc, argv);
            return code;
        }
        printf("%d\n", child < 0 ? 127 : wait_for(child));
        fflush(stdout);
    }
    PMPI_Finalize();
    _exit(0);
}

/* The parent's MPI is not the child's to end. */
int MPI_Finalize(void) { return MPI_SUCCESS; }
