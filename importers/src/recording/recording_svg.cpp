#include <tweenfall/importers/recording_file.h>
