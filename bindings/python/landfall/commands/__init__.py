"""The subcommands; each module's run() is one."""
