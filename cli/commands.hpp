#pragma once

namespace wormdrive {

class CommandSet;

// Every command of the program adds itself, with its options, from its file in commands/. main.cpp lists them.

void add_new(CommandSet& commands);
void add_list(CommandSet& commands);
void add_check(CommandSet& commands);
void add_schema(CommandSet& commands);
void add_run(CommandSet& commands);
void add_view(CommandSet& commands);
void add_statics(CommandSet& commands);
void add_steady(CommandSet& commands);
void add_efficiency(CommandSet& commands);
void add_fmu(CommandSet& commands);
void add_plot(CommandSet& commands);
void add_report(CommandSet& commands);
void add_diff(CommandSet& commands);
void add_export(CommandSet& commands);
void add_sweep(CommandSet& commands);
void add_summary(CommandSet& commands);
void add_worst(CommandSet& commands);
void add_rare(CommandSet& commands);
void add_replay(CommandSet& commands);
void add_merge(CommandSet& commands);
void add_diagnose(CommandSet& commands);

}  // namespace wormdrive
