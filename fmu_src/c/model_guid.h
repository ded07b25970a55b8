/* The GUID of the model description. The build replaces this one, which serves to compile the sources
 * in place, by one that follows from the content of the FMU. */
#ifndef SLIDER_MODEL_GUID_H
#define SLIDER_MODEL_GUID_H

#define MODEL_GUID "00000000-0000-0000-0000-000000000000"

#endif
